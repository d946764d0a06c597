// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/scenario/key_meanings.hpp"

#include "contact/law_list.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace plekton::apps {
namespace {

constexpr std::array kOfSimulation = std::to_array<KeyMeaning>({
    {"simulation.duration", "simulated time"},
    {"simulation.time_step", "auto: 0.65 of the critical one, and shorter where bodies are fast"},
    {"simulation.gravity", "acceleration of all that is free"},
    {"simulation.damping", "numerical: part of a force taken off or added against the motion"},
    {"simulation.damp_gravity", "false: a free fall is not damped"},
    {"simulation.self_contact", "whether a membrane touches itself where it folds"},
    {"simulation.skin", "how far apart pairs are listed; for the speed, not the result"},
    {"simulation.seed", "of the random numbers that place grains"},
    {"simulation.threads", "the result is the same for any number"},
    {"stop.kinetic_energy", "the run ends when the kinetic energy is below"},
    {"stop.unbalanced_force", "it ends when the unbalanced force ratio is below"},
    {"stop.servo.load", "it ends when what this servo drives bears the wanted force or torque"},
    {"stop.servo.tolerance", "part of the wanted force"},
    {"stop.displacement.plane", "it ends when this plane has moved"},
    {"stop.displacement.rigid_body", "or the centre of this body"},
    {"stop.displacement.membrane", "or the mean of nodes of this membrane"},
    {"stop.displacement.grains", "or of these grains"},
    {"stop.displacement.nodes", "which of them"},
    {"stop.displacement.distance", "by this, from the start of the run"},
    {"stop.strain.between", "two planes or rigid bodies, of whose distance it is a part"},
    {"stop.strain.strain", "it ends when the distance has changed by this part"},
    {"stop.force.reaction", "it ends when this reaction"},
    {"stop.force.component", "along this axis"},
    {"stop.force.above", "is above this force"},
    {"stop.force.below", "or below this one"},
    {"stop.after", "no rest and no servo counts before; without it once they did not hold"},
});

constexpr std::array kOfMaterials = std::to_array<KeyMeaning>({
    {"materials.NAME.density", "of the grains of this material"},
    {"materials.NAME.young_modulus", "of contacts, not of a structure"},
    {"materials.NAME.stiffness_ratio", "tangential over normal stiffness of a contact"},
    {"materials.NAME.friction_angle", "of contacts; the smaller one of both bodies"},
    {"materials.NAME.poisson_ratio", "of the solid, for the laws after Hertz"},
    {"contacts[].between", "a material"},
    {"contacts[].and", "the other one; the same for bodies of one material"},
    {"contacts[].law", "what the two do where they touch"},
});

constexpr std::array kOfMembranes = std::to_array<KeyMeaning>({
    {"membranes[].name", "what loads and outputs call it"},
    {"membranes[].mesh", "file of triangles (.off .obj .stl .ply .msh .vtp), or give a shape"},
    {"membranes[].ondem", "ON-DEM file of plekton export-ondem, instead of a mesh or shape"},
    {"membranes[].ondem_membrane", "which membrane of it; the only one if not given"},
    {"membranes[].weld", "points this near become one"},
    {"membranes[].fill_holes", "holes are filled over the nodes of their rims"},
    {"membranes[].longest_hole", "largest perimeter of a hole that is filled"},
    {"membranes[].wrap", "the surface is replaced by a closed one around it"},
    {"membranes[].wrap_detail", "size of the details that survive the wrap"},
    {"membranes[].target_edge", "facets are replaced by even ones of about this size"},
    {"membranes[].refuse_intersections", "a mesh that intersects itself is an error"},
    {"membranes[].scale", "factor of its size, before it is turned and moved"},
    {"membranes[].translate", "by which it is moved, at last"},
    {"membranes[].rotate.axis", "through the origin"},
    {"membranes[].rotate.angle", "by which it is turned"},
    {"membranes[].mode", "what resists: beams or bars along the edges, or a thin sheet"},
    {"membranes[].thickness", "of the facets, and diameter of cylinders and bars"},
    {"membranes[].material", "of its contacts"},
    {"membranes[].yield_stress", "of beams, bars: the outermost fibre yields"},
    {"membranes[].hardening", "stress per plastic strain beyond the yield stress"},
    {"membranes[].strength",
     "of the fibre at which a beam breaks; membrane stress at which a sheet tears"},
    {"membranes[].rupture_strain", "plastic strain at which it breaks"},
    {"membranes[].wire", "force by strain when it is first pulled, instead of a modulus"},
    {"membranes[].twist_wire", "the same of the twists of a hexagonal net"},
    {"membranes[].sheet_stiffness", "E t of the sheet that the beams stand for, or of the sheet"},
    {"membranes[].young_modulus", "of the beams, bars or sheet"},
    {"membranes[].poisson_ratio", "of a sheet; of beams for their torsion"},
    {"membranes[].prestrain",
     "by which it is stretched at the start, all ways; below 0 it is slack"},
    {"membranes[].rest_pressure",
     "inside minus outside, under which it stands at the start as it is drawn"},
    {"membranes[].bending_stiffness", "of a continuum; E t^3 / (12 (1 - nu^2)) if not given"},
    {"membranes[].mass_mode", "mass from the edges, or from the facets"},
    {"membranes[].nodal_inertia", "of a ball of the wire's radius, or of the length of the edges"},
    {"membranes[].areal_mass", "mass over area, or give the density"},
    {"membranes[].density", "of round beams (edge), of the plate (area)"},
    {"membranes[].hold", "which nodes are held"},
    {"membranes[].hold_rotation", "held nodes do not turn either"},
    {"membranes[].velocity", "of the held nodes"},
    {"membranes[].initial_velocity", "of the other nodes, at the start"},
    {"membranes[].initial_velocities", "instead, one for each point of a shape that tells them"},
});

constexpr std::array kOfShapes = std::to_array<KeyMeaning>({
    {"membranes[].shape.width", "along x"},
    {"membranes[].shape.length", "along y; of a tube along z"},
    {"membranes[].shape.cells", "along each axis; of a tube around and along it"},
    {"membranes[].shape.pattern", "how a cell is cut into facets"},
    {"membranes[].shape.radius", "of the middle surface"},
    {"membranes[].shape.subdivisions", "20 x 4^n facets"},
    {"membranes[].shape.size", "from the origin to the opposite corner"},
    {"membranes[].shape.open", "sides that are left out, as in [\"z_max\"]"},
    {"membranes[].shape.closed", "ends over which there are discs, as in [\"z_min\", \"z_max\"]"},
    {"membranes[].shape.rib_pitch", "along x from rib to rib, between axes"},
    {"membranes[].shape.bar_pitch", "along y from bar to bar, between axes"},
    {"membranes[].shape.apertures", "along x and along y"},
    {"membranes[].shape.divisions",
     "elements from one junction or point to the next; of a quarter of a ring"},
    {"membranes[].shape.mesh_size", "from twist to twist, between axes"},
    {"membranes[].shape.twist_length", "of two wires wound around each other"},
    {"membranes[].shape.wire_height", "of a single wire, along y"},
    {"membranes[].shape.ring_diameter", "between the axes of the wire"},
    {"membranes[].shape.rings", "along x and along y"},
    {"membranes[].shape.meshes", "across, and rows of twists"},
    {"membranes[].shape.points",
     "of all nodes, corners of a polygon, or through which a chain goes"},
    {"membranes[].shape.facets", "three points each, by their numbers from 0"},
    {"membranes[].shape.bars",
     "two points each, by their numbers from 0; of facets those that are no side of one"},
});

constexpr std::array kOfGrains = std::to_array<KeyMeaning>({
    {"grains[].name", "what loads and outputs call them"},
    {"grains[].material", "with a density"},
    {"grains[].centres", "a grain at each of these places, instead of count and box"},
    {"grains[].radius", "of all, or give sieves"},
    {"grains[].radii", "of each of the centres, instead of radius"},
    {"grains[].passing_by", "what passing counts"},
    {"grains[].sieves[].sieve", "diameter, increasing"},
    {"grains[].sieves[].passing", "part that is smaller, from 0 to 1"},
    {"grains[].mass", "of all together"},
    {"grains[].volume", "of the solids of all together"},
    {"grains[].count", "how many"},
    {"grains[].box.min", "lower corner of the space that they are placed in"},
    {"grains[].box.max", "upper corner"},
    {"grains[].cylinder.from", "centre of one end of the space, instead of a box"},
    {"grains[].cylinder.to", "centre of the other end"},
    {"grains[].cylinder.radius", "of the space"},
    {"grains[].inside",
     "name of a closed membrane or rigid body that holds them, instead of a box"},
    {"grains[].placement",
     "one after the other at random, on a face-centred cubic lattice, or grown"},
    {"grains[].porosity", "of the space, instead of count, mass or volume"},
    {"grains[].stress", "mean pressure up to which packed grains grow"},
    {"grains[].table", "file of a grain in each row, x,y,z,r (CSV), instead of all of these"},
    {"grains[].ondem", "ON-DEM file (VTKHDF) with places, radii and motions of spheres, likewise"},
    {"grains[].ondem_block", "only those of this block (display group) of it"},
    {"grains[].ondem_material", "only those of this material of it, by its label or number"},
    {"grains[].velocity", "at the start"},
    {"grains[].angular_velocity", "at the start"},
    {"grains[].velocities", "instead of velocity, one for each of the centres"},
    {"grains[].angular_velocities", "likewise"},
    {"grains[].seed", "of the random numbers that place them"},
    {"planes[].name", "what loads and outputs call it"},
    {"planes[].point", "any point of a flat one, on the axis of a cylinder, centre of a sphere"},
    {"planes[].normal", "into the space of the bodies; any length"},
    {"planes[].axis", "of a cylinder, and about which a container turns; any length"},
    {"planes[].radius", "of the inside"},
    {"planes[].velocity", "constant"},
    {"planes[].angular_velocity", "constant, about the axis, or the normal, through the point"},
    {"planes[].material", "of its contacts"},
});

constexpr std::array kOfRigidBodies = std::to_array<KeyMeaning>({
    {"rigid_bodies[].name", "what loads and outputs call it"},
    {"rigid_bodies[].spheres[].centre", "before scale, rotate and translate"},
    {"rigid_bodies[].spheres[].radius", "before scale; spheres may overlap"},
    {"rigid_bodies[].thickness",
     "of its facets, in contact; of a shell its mass too; diameter of bars"},
    {"rigid_bodies[].filling", "what has mass: the enclosed volume, or the facets"},
    {"rigid_bodies[].density", "of what has mass, or give the mass"},
    {"rigid_bodies[].mass", "of all of it"},
    {"rigid_bodies[].inertia", "about its centre along x, y and z; else that of its shape"},
    {"rigid_bodies[].centre", "of mass, in the scene; else that of its shape"},
    {"rigid_bodies[].hold", "along which axes it keeps its velocity"},
    {"rigid_bodies[].hold_rotation", "about which axes it keeps its angular velocity"},
    {"rigid_bodies[].velocity", "of its centre, at the start; along held axes for good"},
    {"rigid_bodies[].angular_velocity", "at the start; about held axes for good"},
});

constexpr std::array kOfTies = std::to_array<KeyMeaning>({
    {"ties[].name", "of its columns in ties.csv"},
    {"ties[].from.membrane", "whose nodes are tied"},
    {"ties[].from.rigid_body", "whose centre is tied, instead of the nodes of a membrane"},
    {"ties[].from.nodes", "which nodes of the membrane"},
    {"ties[].to.place", "a point in space"},
    {"ties[].to.membrane", "to which each of them is tied where it is nearest"},
    {"ties[].to.rigid_body",
     "instead of a membrane: its surface, or of kind nodes its centre; of kind body on which each "
     "is held where it is"},
    {"ties[].to.nodes", "which nodes of the membrane"},
    {"ties[].to.friction", "coefficient, of the force along the cable over that across it"},
    {"ties[].to.slip_force", "added to friction: force along the cable at which it slides"},
    {"ties[].within", "what is further away at the start is not tied"},
    {"ties[].stiffness",
     "of the spring that each tie is; else that of the bars, beams and sheets "
     "around its softer end"},
    {"ties[].rest_length", "beyond which it pulls"},
    {"ties[].only_pulls", "whether it is slack where it is shorter"},
    {"ties[].strength", "tension at which it breaks"},
    {"ties[].brake.force", "tension at which it pays out"},
    {"ties[].brake.stroke", "how much it pays out; after that it is a spring again"},
    {"ties[].each", "whether ties.csv has each of its ties too"},
});

constexpr std::array kOfLoads = std::to_array<KeyMeaning>({
    {"loads[].name", "what messages call it"},
    {"loads[].membrane", "on which it acts, or whose nodes"},
    {"loads[].grains", "whose nodes, instead of those of a membrane"},
    {"loads[].rigid_body", "as a whole, instead of the nodes of a membrane"},
    {"loads[].plane", "that is moved or driven"},
    {"loads[].nodes", "which nodes of the body; a side is where a coordinate is least or greatest"},
    {"loads[].factor", "multiplies the load: numbers at times, straight lines between"},
    {"loads[].components", "along which the nodes go as told"},
    {"loads[].displacement", "times the change of factor"},
    {"loads[].velocity", "times factor"},
    {"loads[].hold_rotation", "the nodes do not turn, or turn as told"},
    {"loads[].turn.point", "on the axis"},
    {"loads[].turn.axis", "about which the nodes go round and turn"},
    {"loads[].turn.angle", "times the change of factor"},
    {"loads[].angular_velocity", "with which the nodes turn, times factor"},
    {"loads[].torque", "on each node; of a servo on the bodies, about the axis"},
    {"loads[].force", "on each node; of a servo on the bodies, along the normal"},
    {"loads[].total_force", "shared evenly by the nodes"},
    {"loads[].pressure", "along the normals of facets; of a servo on the bodies"},
    {"loads[].by_volume", "pressure by the volume that a closed membrane holds"},
    {"loads[].gas.outside_pressure", "absolute; with gas the pressure follows the volume"},
    {"loads[].gas.exponent", "of the volume: 1 isothermal, 1.4 air without exchange of heat"},
    {"loads[].area", "of the plate, for its pressure"},
    {"loads[].between", "planes that face each other: their distances make the area"},
    {"loads[].speed", "at most; without contacts it comes with this"},
    {"loads[].direction", "along which the rigid body is pressed on the others"},
    {"loads[].about", "axis through the centre of the rigid body about which a torque turns it"},
    {"loads[].angular_speed", "of a torque, at most; without contacts it turns with this"},
    {"loads[].gain", "of the controller: part of the force error that a step takes away"},
    {"loads[].stiffness", "along x, y and z, of each node, to where it is at the start"},
    {"loads[].ratio", "of critical damping, along each beam or in each facet"},
    {"loads[].rate", "force over mass and velocity"},
});

constexpr std::array kOfOutput = std::to_array<KeyMeaning>({
    {"output.interval", "between frames for ParaView"},
    {"output.history_interval", "between rows of energy.csv"},
    {"output.reactions_interval", "between rows of reactions.csv"},
    {"output.checkpoint_wall_interval",
     "time of the clock between checkpoints for --resume, of which the last one stays until the "
     "run ends; it changes nothing else"},
    {"output.checkpoint_interval", "between checkpoints, from which plekton run --resume goes on"},
    {"output.hash_interval", "steps between hashes of the state in run.json"},
    {"output.grains", "whether grains.pvd is written"},
    {"output.membranes", "whether membranes.pvd is written"},
    {"output.contacts", "whether contacts.pvd is written"},
    {"output.contact_list", "whether contacts.csv is written: every contact of every frame"},
    {"output.reactions[].name", "of its columns"},
    {"output.reactions[].about", "point of the moment; else that of the plane, or the origin"},
    {"output.reactions[].plane", "what all bodies do to it"},
    {"output.reactions[].membrane", "whose supports or contacts"},
    {"output.reactions[].grains", "whose supports or contacts"},
    {"output.reactions[].rigid_body", "what it, its supports or its contacts bear"},
    {"output.reactions[].nodes", "which of its nodes"},
    {"output.measures[].name", "of its file, measures/NAME.csv"},
    {"output.measures[].sphere.centre", "of the region, instead of the box around all grains"},
    {"output.measures[].sphere.radius", "of the region"},
    {"output.measures[].box.min", "lower corner of the region"},
    {"output.measures[].box.max", "its upper corner"},
    {"output.measures[].cylinder.from", "centre of one end of the region"},
    {"output.measures[].cylinder.to", "centre of the other end"},
    {"output.measures[].cylinder.radius", "of the region"},
    {"output.measures[].heights.bottom", "of the box around all grains, what is above"},
    {"output.measures[].heights.top", "and below this height"},
    {"output.measures[].between", "planes that cut the region, where they are at any time"},
});

constexpr std::array kOfStages = std::to_array<KeyMeaning>({
    {"stages[].name", "what messages, run.json and --from call it; names must differ"},
    {"stages[].max_duration", "the run fails where the stage has not ended by then"},
    {"stages[].end.duration", "the stage ends after this time"},
    {"stages[].end.kinetic_energy", "it ends when the kinetic energy is below"},
    {"stages[].end.unbalanced_force", "it ends when the unbalanced force ratio is below"},
    {"stages[].end.servo.load", "it ends when what this servo drives bears the wanted force"},
    {"stages[].end.servo.tolerance", "part of the wanted force"},
    {"stages[].end.displacement.plane", "it ends when this plane has moved"},
    {"stages[].end.displacement.rigid_body", "or the centre of this body"},
    {"stages[].end.displacement.membrane", "or the mean of nodes of this membrane"},
    {"stages[].end.displacement.grains", "or of these grains"},
    {"stages[].end.displacement.nodes", "which of them"},
    {"stages[].end.displacement.distance", "by this, from the start of the stage"},
    {"stages[].end.strain.between", "two planes or rigid bodies, of whose distance it is a part"},
    {"stages[].end.strain.strain", "it ends when the distance has changed by this part"},
    {"stages[].end.force.reaction", "it ends when this reaction"},
    {"stages[].end.force.component", "along this axis"},
    {"stages[].end.force.above", "is above this force"},
    {"stages[].end.force.below", "or below this one"},
    {"stages[].end.after", "no rest and no servo counts before; without it once they did not hold"},
    {"stages[].remove[].membrane", "that is taken out"},
    {"stages[].remove[].grains",
     "of which some are taken out; or plane, load or rigid_body, by name"},
    {"stages[].remove[].above", "those with their centres above this height"},
    {"stages[].remove[].below", "and below this height"},
    {"stages[].remove[].box.min", "and in this box"},
    {"stages[].remove[].box.max", "its larger corner"},
    {"stages[].fix[].membrane", "whose nodes are held from the start of the stage on"},
    {"stages[].fix[].rigid_body", "that is held along and about all axes from then on"},
    {"stages[].fix[].grains", "likewise"},
    {"stages[].fix[].nodes", "which of them"},
    {"stages[].free[].membrane", "whose nodes are free from the start of the stage on"},
    {"stages[].free[].rigid_body", "that is free along and about all axes from then on"},
    {"stages[].free[].grains", "likewise"},
    {"stages[].free[].nodes", "which of them"},
});

/// Parameters of laws have their meaning with the law.
std::string_view meaning_of_parameter(std::string_view name) {
  std::string_view meaning;
  const auto look = [&](const auto& parameters) {
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const auto& parameter) { return parameter.name == name; });
    if (found != parameters.end()) meaning = found->what;
  };
  look(contact::common_law_parameters());
  for (const contact::LawEntry& law : contact::contact_laws()) {
    look(law.parameters);
    look(law.choices);
  }
  return meaning;
}

}  // namespace

std::vector<KeyMeaning> key_meanings() {
  std::vector<KeyMeaning> all;
  for (const std::span<const KeyMeaning> table :
       {std::span<const KeyMeaning>(kOfSimulation), std::span<const KeyMeaning>(kOfMaterials),
        std::span<const KeyMeaning>(kOfMembranes), std::span<const KeyMeaning>(kOfShapes),
        std::span<const KeyMeaning>(kOfGrains), std::span<const KeyMeaning>(kOfRigidBodies),
        std::span<const KeyMeaning>(kOfTies), std::span<const KeyMeaning>(kOfLoads),
        std::span<const KeyMeaning>(kOfOutput), std::span<const KeyMeaning>(kOfStages)})
    all.insert(all.end(), table.begin(), table.end());
  return all;
}

std::string_view meaning_of_key(std::string_view path) {
  constexpr std::string_view kContacts = "contacts[].";
  constexpr std::string_view kRigid = "rigid_bodies[].";
  for (const KeyMeaning& meaning : key_meanings())
    if (meaning.path == path) return meaning.what;
  // Surfaces of both are made and placed alike.
  if (path.starts_with(kRigid))
    return meaning_of_key("membranes[]." + std::string(path.substr(kRigid.size())));
  return path.starts_with(kContacts) ? meaning_of_parameter(path.substr(kContacts.size()))
                                     : std::string_view();
}

}  // namespace plekton::apps
