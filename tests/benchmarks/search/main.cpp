// SPDX-License-Identifier: GPL-3.0-or-later
// plekton-bench-search: what searches of surfaces cost, Plekton's, CGAL's and FCL's in one program,
// as JSON lines: processor time of making what can be asked, and of asking.
#include "tests/benchmarks/search/codes.hpp"
#include "tests/support/seeded_random.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <string>

namespace plekton::benchmarks {
namespace {

using geometry::Vec3;
using Json = nlohmann::ordered_json;

struct Options {
  int facets = 500000;
  int questions = 10000;
  int repetitions = 3;
  std::vector<std::string> scenes{"near", "far", "rings", "waves", "tilted", "flat"};
  std::vector<std::string> codes{"plekton", "cgal", "fcl"};
};

/// Beside a surface, some edges of it away; or 30 m from it, ten times its size.
std::vector<Vec3> points_around(const Shape& shape, bool is_far, const Options& options) {
  test::Random random(1);
  const double near = 4.0 / std::sqrt(options.facets);
  std::vector<Vec3> points;
  for (int i = 0; i < options.questions; ++i) {
    const Vec3 away = is_far ? Vec3(30.0 * random.direction()) : random.in_cube(near);
    points.push_back(shape.points[random.index(shape.points.size())] + away);
  }
  return points;
}

using Ask = std::function<Answer(const std::string& code)>;

Ask nearest_points(const Options& options, bool is_far) {
  const Shape shape = placed(rippled_ring(options.facets), 0.7, Vec3(3, 1, 2));
  const auto points = points_around(shape, is_far, options);
  return [shape, points](const std::string& code) {
    return code == "cgal" ? nearest_by_cgal(shape, points) : nearest_by_plekton(shape, points);
  };
}

Ask distance_of(const Shape& a, const Shape& b) {
  return [a, b](const std::string& code) {
    return code == "fcl" ? distance_by_fcl(a, b) : distance_by_plekton(a, b);
  };
}

/// The question of a scene, as a function of the code that answers.
Ask question_of(const std::string& scene, const Options& options) {
  if (scene == "near" || scene == "far") return nearest_points(options, scene == "far");
  const int n = options.facets;
  if (scene == "rings") {
    return distance_of(placed(rippled_ring(n), 0.7, Vec3(3, 1, 2)),
                       placed(rippled_ring(n), 1.9, Vec3(5.5, 1.2, 2.4)));
  }
  const Vec3 none = Vec3::Zero();
  if (scene == "waves") {  // 5 cm high, moved along each other
    return distance_of(placed(sheet(n, 0.05), 0.7, none),
                       placed(sheet(n, 0.05), 0.7, Vec3(0.02, -0.01, 0.06)));
  }
  const double angle = scene == "tilted" ? 0.7 : 0.0;
  return distance_of(placed(sheet(n, 0.0), angle, none),
                     placed(sheet(n, 0.0), angle, Vec3(0.0103, 0.0207, 0.02)));
}

void run(const Options& options) {
  std::map<std::string, Ask> questions;
  for (const std::string& scene : options.scenes)
    questions.emplace(scene, question_of(scene, options));
  for (int repetition = 0; repetition < options.repetitions; ++repetition) {
    for (const std::string& scene : options.scenes) {
      const std::string peer = scene == "near" || scene == "far" ? "cgal" : "fcl";
      for (const std::string& code : options.codes) {
        if (code != "plekton" && code != peer) continue;
        const Answer answer = questions.at(scene)(code);
        const double ms = 1e3 * (answer.build_s + answer.ask_s);
        std::cout << Json{{"scene", "search_" + scene},
                          {"code", code},
                          {"size", options.facets},
                          {"repetition", repetition},
                          {"build_s", answer.build_s},
                          {"ask_s", answer.ask_s},
                          {"distance_m", answer.distance},
                          {"steps", 1},
                          {"ms_per_step", ms},
                          {"cpu_ms_per_step", ms},
                          {"contacts", 0}}
                         .dump()
                  << std::endl;
      }
    }
  }
}

}  // namespace
}  // namespace plekton::benchmarks

int main(int argc, char** argv) {
  using namespace plekton::benchmarks;
  Options options;
  CLI::App app{"Times searches of surfaces beside CGAL's and FCL's; prints JSON lines."};
  app.add_option("--facets", options.facets, "of each surface, about")
      ->capture_default_str()
      ->check(CLI::Range(100, 10000000));
  app.add_option("--questions", options.questions, "points whose nearest is asked for")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000000));
  app.add_option("--repetitions", options.repetitions, "in turns")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("--scenes", options.scenes, "what is asked")
      ->capture_default_str()
      ->check(CLI::IsMember({"near", "far", "rings", "waves", "tilted", "flat"}));
  app.add_option("--codes", options.codes, "who answers")
      ->capture_default_str()
      ->check(CLI::IsMember({"plekton", "cgal", "fcl"}));
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& error) {
    std::cerr << "plekton-bench-search: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
