// SPDX-License-Identifier: GPL-3.0-or-later
// A contact law of one's own: a ball that bounces on a floor with a spring that is stiffer when it
// unloads (Walton & Braun, J. Rheology 30 (1986) 949-980). SI units throughout.
#include <plekton/contact/models.hpp>
#include <plekton/dynamics/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>

using namespace plekton;

/// Loads with k1, unloads and loads again with k2 from the deepest point on: the restitution is
/// sqrt(k1 / k2). No friction.
struct WaltonBraun : contact::LawDefaults {
  static constexpr std::string_view name = "walton_braun";
  static constexpr double kRatio = 4.0;  ///< k2 / k1
  struct Parameters {
    double loading;  ///< N/m, k1
  };
  struct History {
    double deepest = 0.0;  ///< m, of the elastic overlap so far
    double pull = 0.0;     ///< N, beside the loading spring
  };

  static Parameters combine(const contact::Body& a, const contact::Body& b) {
    return {std::min(a.material.young_modulus * a.radius, b.material.young_modulus * b.radius)};
  }
  static Parameters scaled(const Parameters& p, double count) { return {count * p.loading}; }

  // The elastic part, by the gap alone: Plekton counts it over the features of a surface.
  static double elastic_normal_force(const Parameters& p, double gap) {
    return p.loading * std::max(0.0, -gap);
  }
  static double elastic_normal_energy(const Parameters& p, double gap) {
    return 0.5 * p.loading * std::max(0.0, -gap) * std::max(0.0, -gap);
  }

  // Everything else, once for each contact and step.
  static contact::ContactForce force(const Parameters& p, const contact::RelativeMotion& motion,
                                     History& history, double dt) {
    const double overlap = motion.elastic_normal_force / p.loading;
    history.deepest = std::max(history.deepest, overlap);
    const double unloading =
        kRatio * p.loading * (overlap - (1.0 - 1.0 / kRatio) * history.deepest);
    const double before = history.pull;
    history.pull =
        std::clamp(unloading, 0.0, motion.elastic_normal_force) - motion.elastic_normal_force;
    return {(motion.elastic_normal_force + history.pull) * motion.normal,
            -0.5 * (before + history.pull) * motion.gap_rate * dt};
  }
  static double history_energy(const Parameters&, const History&) { return 0.0; }

  // What the time step has to be safe for.
  static double normal_stiffness(const Parameters& p, double) { return kRatio * p.loading; }
  static double tangential_stiffness(const Parameters&, double) { return 0.0; }

  // How histories turn with the contact, split and merge.
  static void rotate(History&, const contact::FrameRotation&) {}
  static void accumulate_history(History& history, const History& other, double share) {
    history.deepest = std::max(history.deepest, other.deepest);
    history.pull += share * other.pull;
  }
};

/// With the name of a file: writes the overlap and the force on the floor there, while they touch.
int main(int argc, char** argv) {
  dynamics::Scene scene;
  const contact::MaterialId stone{0};
  scene.materials = {{.young_modulus = 1e9, .stiffness_ratio = 0.0, .friction = 0.0}};
  scene.add_sphere({0, 0, 0.15}, 0.05, 2650.0, stone);  // centre, radius, density
  scene.planes.push_back({{0, 0, 0}, {0, 0, 1}, {0, 0, 0}, stone});

  dynamics::Simulation run(scene, {.time_step = 5e-6, .motion = {.gravity = {0, 0, -9.81}}},
                           contact::model_of<WaltonBraun>());
  std::ofstream table;
  if (argc > 1) table.open(argv[1]);
  table << "overlap (m),force (N)\n";
  double highest = 0.0;
  bool has_touched = false;
  while (run.time() < 0.28) {
    run.step();
    const bool touches = run.contacts().counts().with_planes > 0;
    has_touched |= touches;
    if (touches)
      table << 0.05 - run.force_positions()[0].z() << ',' << -run.plane_reaction(0).force.z()
            << '\n';
    if (has_touched) highest = std::max(highest, run.state().position[0].z() - 0.05);
  }
  std::cout << "fell 0.1 m, rebounds " << highest << " m: restitution " << std::sqrt(highest / 0.1)
            << '\n';
}
