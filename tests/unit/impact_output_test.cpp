// What an impact leaves: histories, result.json, fragments, formulas beside. Results are made by hand; nothing
// runs.
#include "impact/impact_output.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "impact/histories.h"
#include "impact/missile.h"
#include "libdem/io/hdf5.h"
#include "tests/unit/impact_scene.h"

using dem::Hdf5File;
using impact::Vec3;
using impact_test::rock_on_slab;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

namespace {

class ImpactOutput : public impact_test::InFolder {};

std::vector<impact::Sample> two_samples() {
  impact::Sample first, second;
  first.displacement = {Vec3(0, 0, 0), Vec3(0, 0, 0)};
  first.impactor_velocity = {0, 0, -40};
  second = first;
  second.time = 0.5e-3;
  second.displacement = {Vec3(0, 0, -1e-3), Vec3(1e-6, 0, 0)};
  second.force = {0, 2, 4000};
  second.impactor_position = {1.25, 1, 0.41};
  second.impactor_velocity = {0, 0, -39};
  second.broken_links = 7;
  return {first, second};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> keys_of(const nlohmann::ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

}  // namespace

TEST_F(ImpactOutput, CurvesHaveUnitsInTheirHeader) {
  const auto lines = lines_of(curves_csv(rock_on_slab(), two_samples()));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0],
            "time[s],displacement_centre_x[m],displacement_centre_y[m],displacement_centre_z[m],"
            "displacement_edge_ 1_x[m],displacement_edge_ 1_y[m],displacement_edge_ 1_z[m],"
            "force_x[N],force_y[N],force_z[N],impulse_x[N s],impulse_y[N s],impulse_z[N s],"
            "impactor_position_x[m],impactor_position_y[m],impactor_position_z[m],"
            "impactor_velocity_x[m/s],impactor_velocity_y[m/s],impactor_velocity_z[m/s],broken_links[-]");
  EXPECT_EQ(lines[2], "0.0005,0,0,-0.001,1e-06,0,0,0,2,4000,0,0.001,2,1.25,1,0.41,0,0,-39,7");
}

TEST_F(ImpactOutput, HistoriesHoldWhatTheSceneHas) {
  impact::Scene scene = rock_on_slab();
  std::vector<impact::Sample> samples = two_samples();
  const auto header = [&] { return lines_of(curves_csv(scene, samples)).front(); };
  EXPECT_THAT(header(), Not(HasSubstr("energy")));
  samples[1].energy.elastic = 12;
  EXPECT_THAT(header(), AllOf(HasSubstr("energy_elastic[J]"), Not(HasSubstr("energy_ties"))));
  scene.impactor.reset();
  EXPECT_THAT(header(), AllOf(HasSubstr("displacement_centre_x"), Not(HasSubstr("impactor")),
                              Not(HasSubstr("force")), Not(HasSubstr("impulse"))));
}

TEST_F(ImpactOutput, HistoryFileHasNamedDatasetsWithUnits) {
  impact::Scene scene = rock_on_slab();
  scene.probes[1].name = "a/b";
  scene.probes.push_back({"a.b", {9, 9, 9}});  // the same once letters are taken out
  std::vector<impact::Sample> samples = two_samples();
  for (impact::Sample& sample : samples) sample.displacement.emplace_back(5, 5, 5);
  write_history(folder / "history.h5", scene, samples);
  const Hdf5File in = dem::open_spall_file(folder / "history.h5", "spall-impact-history", 1);
  EXPECT_THAT(in.read<double>("time"), ElementsAre(0, 0.5e-3));
  EXPECT_EQ(in.text_attribute("time", "unit"), "s");
  EXPECT_THAT(in.read<double>("displacement/centre", 3), ElementsAre(0, 0, 0, 0, 0, -1e-3));
  EXPECT_THAT(in.numbers_attribute<double>("displacement/centre", "point"), ElementsAre(1.25, 1, 0));
  EXPECT_EQ(in.text_attribute("displacement/centre", "unit"), "m");
  EXPECT_THAT(in.read<double>("displacement/a_b", 3), ElementsAre(0, 0, 0, 1e-6, 0, 0));
  EXPECT_THAT(in.read<double>("displacement/a_b_", 3), ElementsAre(5, 5, 5, 5, 5, 5));
  EXPECT_THAT(in.read<double>("impulse", 3), ElementsAre(0, 0, 0, 0, 0.001, 2));
  EXPECT_EQ(in.text_attribute("impulse", "unit"), "N s");
  EXPECT_THAT(in.text_attribute("force", "meaning"), HasSubstr("on the impactor"));
}

TEST_F(ImpactOutput, ResultHasTheKeysThatUsersRelyOn) {
  impact::Scene scene = rock_on_slab();
  impact::ImpactResult found;
  found.elements = 120;
  found.links = 700;
  found.max_displacement = {{"centre", 1e-3}};
  found.impulse = {3, 0, 4};
  found.residual_velocity = -2;
  found.impactor.passage = impact::Passage::rebounded;
  found.impactor.nose_depth = -0.01;
  found.history.resize(3);
  found.history[0].impactor_position.z() = 0.43;
  found.history[1].impactor_position.z() = 0.40;  // the deepest
  found.history[2].impactor_position.z() = 0.44;
  found.energy = {100, 1, 2, 4, 8, 16, 32, 0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625};
  found.energy_balance_error = std::numeric_limits<double>::quiet_NaN();
  found.warnings = {"damage reaches the overlap"};
  found.losses.scab.volume = 0.01;
  found.fragments.fragments.resize(3);
  found.fragments.fragments[1].elements = 2;
  found.fragments.fragments[1].mass = 0.4;
  found.fragments.fragments[1].velocity = {0, 3, -4};
  found.fragments.fragments[2].elements = 1;
  found.fragments.fragments[2].mass = 0.1;
  const auto result = impact::result_of(scene, found, 3);
  EXPECT_THAT(keys_of(result), IsSupersetOf({"model",
                                             "elements",
                                             "fe_nodes",
                                             "links",
                                             "steps",
                                             "time_step",
                                             "simulated_time",
                                             "wall_seconds",
                                             "max_displacement",
                                             "peak_force",
                                             "impulse",
                                             "residual_velocity",
                                             "broken_links",
                                             "damage_volume",
                                             "energy",
                                             "threads",
                                             "step_loop_seconds",
                                             "overlap_solve_seconds",
                                             "state_sha256",
                                             "momentum_error",
                                             "warnings",
                                             "perforated",
                                             "crater",
                                             "scab",
                                             "fragments",
                                             "formulas"}));
  EXPECT_EQ(result["model"], "de");
  EXPECT_EQ(result["threads"], 3);
  EXPECT_EQ(result["elements"], 120);
  EXPECT_EQ(result["impulse"], 5);
  EXPECT_EQ(result["max_displacement"]["centre"], 1e-3);
  EXPECT_EQ(result["energy"]["initial"], 100);
  EXPECT_EQ(result["energy"]["final"], 63.984375);
  EXPECT_EQ(result["impactor"]["passage"], "rebounded");
  EXPECT_NEAR(result["impactor"]["largest_nose_depth"].get<double>(), 0.03, 1e-12);
  EXPECT_EQ(result["perforated"], false);
  EXPECT_EQ(result["scab"]["volume"], 0.01);
  EXPECT_EQ(result["fragments"]["detached"], 2);
  EXPECT_EQ(result["fragments"]["detached_mass"], 0.5);
  EXPECT_EQ(result["fragments"]["highest_speed"], 5);
  EXPECT_EQ(result["warnings"][0], "damage reaches the overlap");
  EXPECT_FALSE(result.contains("multipliers"));
  EXPECT_THAT(result.dump(), HasSubstr("\"balance_error\":null"));

  scene.model = impact::Model::coupled;
  scene.surroundings.emplace().solve = coupling::MultiplierSolve::lumped;
  scene.impactor.reset();
  const auto other = impact::result_of(scene, found, 1);
  EXPECT_EQ(other["model"], "coupled");
  EXPECT_EQ(other["multipliers"], "lumped");
  EXPECT_FALSE(other.contains("impactor"));
}

TEST_F(ImpactOutput, FragmentsAreRows) {
  impact::Fragments fragments;
  fragments.fragments.resize(2);
  fragments.fragments[0] = {90, 0, 60, 0.02, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 10};
  fragments.fragments[1] = {1, 5, 0.5, 2e-4, {0.1, 0, 0}, {0, 0, -30.5}, {0.01, 0.01, 0.01}, 225};
  const auto lines = lines_of(fragments_csv(fragments));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[0], testing::StartsWith("fragment[-],elements[-],mass[kg],solid_volume[m3],centre_x[m]"));
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), ','), 13);
  EXPECT_EQ(lines[1], "0,90,60,0.02,1,2,3,4,5,6,7,8,9,10");
  EXPECT_EQ(lines[2], "1,1,0.5,0.0002,0.1,0,0,0,0,-30.5,0.01,0.01,0.01,225");
}

TEST(ImpactMissile, FormulasSpeakOfARockOnASlab) {
  const impact::FormulaCheck check = impact::check_formulas(rock_on_slab());
  ASSERT_EQ(check.misfit, "");
  // Of equal area sqrt(4 0.09/pi), of equal perimeter 1.2/pi.
  EXPECT_NEAR(check.missile.diameter, 0.33851, 1e-5);
  EXPECT_NEAR(check.perimeter_diameter, 0.38197, 1e-5);
  EXPECT_NEAR(check.ndrc.penetration_depth, 0.0548, 1e-4);
  EXPECT_NEAR(check.missile.mass, 67.5, 1e-9);
  ASSERT_TRUE(check.cea_edf.has_value());
  EXPECT_NEAR(check.cea_edf->perforation_velocity, 124.6, 0.3);
  const auto result = impact::result_of(rock_on_slab(), {}, 1)["formulas"];
  EXPECT_EQ(result["apply"], true);
  EXPECT_EQ(result["ndrc"]["perforates"], false);
  EXPECT_EQ(result["ndrc"]["scabs"], true);
  // Its f_c is below what CEA-EDF was fitted to, and the range says so.
  EXPECT_EQ(result["cea_edf"]["in_range"], false);
  int outside = 0;
  for (const auto& range : result["cea_edf"]["ranges"])
    if (!range["holds"]) {
      EXPECT_EQ(range["quantity"], "f_c [MPa]");
      EXPECT_EQ(range["value"], 20);
      ++outside;
    }
  EXPECT_EQ(outside, 1);
}

TEST(ImpactMissile, FormulasSayWhyTheySayNothing) {
  const auto misfit = [](auto change) {
    impact::Scene scene = rock_on_slab();
    change(scene);
    return impact::check_formulas(scene).misfit;
  };
  using impact::Scene;
  EXPECT_EQ(misfit([](Scene&) {}), "");
  EXPECT_THAT(misfit([](Scene& s) { s.impactor.reset(); }), HasSubstr("no impactor"));
  EXPECT_THAT(misfit([](Scene& s) { s.compressive_strength = 0; }), HasSubstr("compressive strength"));
  EXPECT_THAT(misfit([](Scene& s) { s.approach.direction = Vec3(1, 0, -1).normalized(); }),
              HasSubstr("along the wall's normal"));
  EXPECT_THAT(misfit([](Scene& s) { s.size = {1, 1, 1}; }), HasSubstr("no wall"));
  EXPECT_THAT(misfit([](Scene& s) {
                s.approach.orientation =
                    impact::leading(impact::Lead::edge, Vec3::Constant(0.15), s.approach.direction);
              }),
              HasSubstr("edge"));
  EXPECT_THAT(misfit([](Scene& s) { s.impactor->shape = impact::make_box(Vec3(3, 3, 1), "test"); }),
              HasSubstr("wider than the wall"));
  EXPECT_EQ(misfit([](Scene& s) { s.impactor->shape = impact::make_sphere(0.3, "test"); }), "");
  // A cylinder must fly along its axis; turned round, its flat back strikes.
  const impact::Cylinder slug = impact::make_cylinder(0.1, 0.3, impact::Nose::hemisphere, "test");
  EXPECT_THAT(misfit([&](Scene& s) {
                s.impactor->shape = slug;
                s.approach.orientation = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX());
              }),
              HasSubstr("along its axis"));
  impact::Scene scene = rock_on_slab();
  scene.impactor->shape = slug;
  EXPECT_DOUBLE_EQ(impact::check_formulas(scene).missile.nose_factor, impact::flat_nose);
  EXPECT_TRUE(impact::check_formulas(scene).cea_edf.has_value());
  scene.approach.orientation = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), -Vec3::UnitZ());
  EXPECT_DOUBLE_EQ(impact::check_formulas(scene).missile.nose_factor, impact::hemispherical_nose);
  EXPECT_FALSE(impact::check_formulas(scene).cea_edf.has_value());
}

TEST(ImpactMissile, TheStruckWallLooksAtTheImpactor) {
  impact::Scene scene = rock_on_slab();
  impact::Slab slab = impact::struck_slab(scene);
  EXPECT_EQ(slab.outward, Vec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(slab.thickness, 0.28);
  EXPECT_DOUBLE_EQ(slab.depth({1, 1, 0.2}), 0.08);
  scene.approach.direction = {1, 0, 0};
  slab = impact::struck_slab(scene);
  EXPECT_DOUBLE_EQ(slab.thickness, 2.5);
  EXPECT_DOUBLE_EQ(slab.depth({0.1, 1, 0.2}), 0.1);
}
