// SPDX-License-Identifier: GPL-3.0-or-later
#include <plekton/contact/among_ranks.hpp>
#include <plekton/contact/models.hpp>
#include <plekton/dynamics/distributed/mpi_job.hpp>
#include <plekton/dynamics/simulation.hpp>

#include <iostream>
#include <memory>
#include <utility>

// Two spheres push each other apart: by itself on one process; started by mpirun, on all of its processes together.
int main() {
  std::unique_ptr<plekton::distributed::MpiJob> job;
  if (plekton::distributed::is_one_of_several())
    job = std::make_unique<plekton::distributed::MpiJob>();
  plekton::contact::ContactModel model = plekton::contact::linear_frictional();
  if (job) model = plekton::contact::among_ranks(model, job->ranks());
  plekton::dynamics::Scene scene;
  scene.materials.push_back({1e6, 0.5, 0.4});
  for (const double x : {0.0, 1.99})
    scene.add_sphere({x, 0.0, 0.0}, 1.0, 1000.0, plekton::contact::MaterialId{0});

  plekton::dynamics::Simulation simulation(std::move(scene), {}, model);
  simulation.step();

  std::cout << "rank " << (job ? job->ranks().rank() : 0) << " of "
            << (job ? job->ranks().count() : 1) << " took a step of " << simulation.time_step()
            << " s\n";
  return simulation.steps() == 1 ? 0 : 1;
}
