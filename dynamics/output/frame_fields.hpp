// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/output/output_field.hpp"

#include <array>

/// Arrays of the frames of grains and structures (scene_frame.hpp).
namespace plekton::dynamics::frame_fields {

// Of points:
inline constexpr OutputField kRadius{"radius", "m", "of the ball, cylinder or facet"};
inline constexpr OutputField kVelocity{"velocity", "m/s", "of the centre or node"};
inline constexpr OutputField kSpin{"angular_velocity", "rad/s", "of the sphere or node"};
inline constexpr OutputField kForce{
    "force", "N",
    "of contacts, bonds, sheets, loads and gravity; at a held node the support bears it"};
inline constexpr OutputField kId{"id", "", "number of the sphere"};
inline constexpr OutputField kNode{"node", "", "number of the node"};
inline constexpr OutputField kGrains{
    "grains", "", "number of the table [[grains]], from 0; run.json has the names"};
// Of points and cells:
inline constexpr OutputField kMaterial{"material", "",
                                       "number of the material, from 0; run.json has the names"};
// Of cells, 0 of those that have none:
inline constexpr OutputField kTension{
    "tension", "N", "of a cylinder, negative in compression; of a facet the mean of its sides"};
inline constexpr OutputField kAxialStress{"axial_stress", "Pa", "tension over area of a bond"};
inline constexpr OutputField kBendingStress{
    "bending_stress", "Pa", "of the outermost fibre of a bond, at the end that is bent most"};
inline constexpr OutputField kTorsionStress{"torsion_stress", "Pa",
                                            "shear stress at the surface of a bond"};
inline constexpr OutputField kLargest{"membrane_force_largest", "N/m",
                                      "larger principal force of a facet of a sheet"};
inline constexpr OutputField kSmallest{"membrane_force_smallest", "N/m", "the smaller one"};
inline constexpr OutputField kPressure{
    "contact_pressure", "Pa",
    "of contacts on a facet: positive from the side that it faces, negative from behind"};
inline constexpr OutputField kShear{"contact_shear", "Pa", "traction of contacts along a facet"};

inline constexpr OutputField kMembrane{
    "membrane", "", "number of the table [[membranes]], from 0; run.json has the names"};

inline constexpr std::array kOfGrains = {kRadius, kVelocity, kSpin,    kForce,
                                         kId,     kGrains,   kMaterial};
inline constexpr std::array kOfNodes = {kVelocity, kSpin, kForce, kNode};
inline constexpr std::array kOfCells = {kRadius,        kTension,  kAxialStress, kBendingStress,
                                        kTorsionStress, kLargest,  kSmallest,    kPressure,
                                        kShear,         kMembrane, kMaterial};

}  // namespace plekton::dynamics::frame_fields
