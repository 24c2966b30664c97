// The case file of an impact: what it gives, and each sentence with which it is refused.
#include "impact/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <utility>

#include "impact/scene_checks.h"
#include "libdem/core/error.h"
#include "libdem/core/sha256.h"
#include "libdem/law/cohesive_link.h"
#include "specimens/specimen_file.h"
#include "tests/unit/scene_refusals.h"
#include "tests/verification/impactor_scene.h"

using dem::Vec3;
using impact::Scene;
using scene_refusals::refusals;
using scene_refusals::sound;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> files_of(const Scene& scene) {
  std::vector<fs::path> files;
  for (const dem::InputFile& input : scene.inputs) files.push_back(input.file);
  return files;
}

/// A Gmsh mesh of one brick.
std::string brick_mesh(double x, double y, double z) {
  std::ostringstream text;
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n";
  for (int k = 0; k < 8; ++k) {
    const bool far_x = k % 4 == 1 || k % 4 == 2, far_y = k % 4 >= 2;
    text << k + 1 << ' ' << (far_x ? x : 0) << ' ' << (far_y ? y : 0) << ' ' << (k >= 4 ? z : 0) << '\n';
  }
  text << "$EndNodes\n$Elements\n1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n";
  return text.str();
}

class SceneFile : public testing::Test {
 protected:
  /// The files that cases name: cards, surfaces, meshes, a specimen, the project's data.
  void SetUp() override {
    folder = fs::temp_directory_path() / ("spall_scene_" + std::to_string(::getpid()) + "_" +
                                          testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder);
    fs::create_directory_symlink(fs::path(SPALL_SOURCE_DIR) / "data", folder / "data");
    const dem::MaterialCard card;
    write("card.toml", dem::to_toml(card));
    std::string poor = dem::to_toml(card);
    poor.erase(poor.find("zeta ="), poor.find('\n', poor.find("zeta =")) + 1 - poor.find("zeta ="));
    write("poor.toml", poor);
    write("rock.stl", impactor_scene::text_stl(impactor_scene::box_surface({50, 50, 50})));
    impactor_scene::Surface open = impactor_scene::box_surface({50, 50, 50});
    open.triangles.pop_back();
    write("open.stl", impactor_scene::text_stl(open));
    write("slab.msh", brick_mesh(1000, 500, 280));
    write("words.msh", "no mesh\n");
    specimens::Specimen specimen;
    specimen.size = {0.6, 0.5, 0.28};
    specimen.seed = 5;
    specimen.interaction_radius_factor = 1.5;
    specimen.centres = {{0.1, 0.1, 0.1}, {0.3, 0.3, 0.1}};
    specimen.radii = {0.01, 0.02};
    specimens::write_specimen(folder / "zone.h5", specimen);
  }
  void TearDown() override { fs::remove_all(folder); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  Scene read(const std::string& text) const {
    write("case.toml", text);
    return impact::read_scene(folder / "case.toml");
  }
  /// The message, without the folder; empty if the case is accepted.
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const dem::InputError& error) {
      std::string message = error.what();
      const std::string place = folder.string() + "/";
      for (std::size_t at = 0; (at = message.find(place)) != std::string::npos;)
        message.erase(at, place.size());
      return message;
    }
    return "";
  }

  fs::path folder;
};

/// `sound` with `from`, which stands in it once, replaced.
std::string edited(const std::string& from, const std::string& to) {
  std::string text = sound;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from << " stands twice";
  return text.replace(at, from.size(), to);
}
std::string box_measures() { return "shape = \"box\"\nsize = \"0.1x0.1x0.1 m\""; }

}  // namespace

TEST_F(SceneFile, GivesWhatItSays) {
  const Scene scene = read(sound);
  EXPECT_EQ(scene.title, "test");
  EXPECT_EQ(scene.model, impact::Model::coupled);
  EXPECT_EQ(scene.size, Vec3(1, 0.5, 0.28));
  EXPECT_EQ(scene.seed, 7u);
  EXPECT_EQ(scene.structure.packing.seed, 7u);
  ASSERT_TRUE(scene.surroundings.has_value());
  const impact::Surroundings& around = *scene.surroundings;
  EXPECT_EQ(around.zone_low, Vec3(0.2, 0, 0));
  EXPECT_EQ(around.zone_high, Vec3(0.8, 0.5, 0.28)) << "faces on the structure's are exactly there";
  EXPECT_THAT(around.box.elements, ElementsAre(20, 10, 4));
  EXPECT_EQ(around.box.zone->overlap_layers, 3);
  EXPECT_NEAR(around.overlap, 0.15, 1e-15);
  EXPECT_FALSE(around.young_modulus.has_value()) << "measured";
  EXPECT_EQ(around.modulus, impact::PackModulus::flexural);
  EXPECT_EQ(around.interval, 2);
  EXPECT_EQ(around.ties, coupling::Ties::displacements);
  // The zone's share by volume: 0.6 of the slab.
  EXPECT_EQ(scene.structure.packing.elements, 7200u);
  EXPECT_TRUE(scene.structure.packing.size.isApprox(Vec3(0.6, 0.5, 0.28), 1e-14));
  ASSERT_EQ(scene.supports.size(), 1u);
  EXPECT_EQ(scene.supports[0].high, Vec3(0.025, 0.5, 0.28));
  EXPECT_THAT(scene.supports[0].locked, ElementsAre(false, false, true));
  ASSERT_EQ(scene.probes.size(), 1u);
  EXPECT_EQ(scene.probes[0].point, Vec3(0.5, 0.25, 0));
  ASSERT_TRUE(scene.impactor.has_value());
  EXPECT_NEAR(scene.impactor->body.mass, 2.5, 1e-12);
  EXPECT_EQ(scene.approach.direction, Vec3(0, 0, -1));
  EXPECT_EQ(scene.approach.speed, 40);
  EXPECT_EQ(scene.duration, 0.002);
  EXPECT_EQ(scene.sample_interval, 1e-6) << "a two-thousandth";
  EXPECT_EQ(scene.frames, 20);
  EXPECT_EQ(scene.compressive_strength, 0);
  EXPECT_THAT(files_of(scene), ElementsAre(folder / "case.toml", folder / "card.toml"));
}

TEST_F(SceneFile, RemembersWhatWasReadAndNotWhatTheFilesBecome) {
  const std::string text = edited(box_measures(), "shape = \"mesh\"\nfile = \"rock.stl\"\nunit = \"mm\"");
  const std::string card = content_of(folder / "card.toml"), rock = content_of(folder / "rock.stl");
  const Scene scene = read(text);
  for (const char* name : {"case.toml", "card.toml", "rock.stl"}) write(name, "another");
  ASSERT_EQ(scene.inputs.size(), 3u);
  EXPECT_EQ(scene.inputs[0].sha256, dem::sha256_of(text));
  EXPECT_EQ(scene.inputs[1].sha256, dem::sha256_of(card));
  EXPECT_EQ(scene.inputs[2].sha256, dem::sha256_of(rock));
}

TEST_F(SceneFile, OneWordSwitchesTheModel) {
  const Scene scene = read(edited("\"coupled\"", "\"de\""));
  EXPECT_EQ(scene.model, impact::Model::de);
  EXPECT_FALSE(scene.surroundings.has_value());
  EXPECT_EQ(scene.structure.packing.elements, 12000u) << "of the same size as in the coupled case";
  EXPECT_EQ(scene.structure.packing.size, Vec3(1, 0.5, 0.28));
  EXPECT_THAT(refusal(edited("\"coupled\"", "\"de\"").replace(sound.find("[20, 10, 4]") - 5, 11, "[20, 10]  ")),
              HasSubstr("mesh.elements"))
      << "what is not used is checked all the same";
  std::string aside = edited("\"coupled\"", "\"de\"");
  aside.replace(aside.find("0.5,0.25,0.14 m"), 15, "0.5,0.75,0.14 m");
  EXPECT_THAT(refusal(aside),
              HasSubstr("impactor.aim: the impactor passes the structure by 0.2 m; aim is a point"));
}

TEST_F(SceneFile, ContactFollowsTheCardUnlessItIsGiven) {
  const dem::MaterialCard card;
  const dem::LinkLaw link = dem::make_link_law(card);
  const impact::ContactLaw law = read(sound).impactor->law;
  EXPECT_EQ(law.modulus, link.normal_modulus);
  EXPECT_EQ(law.shear_ratio, link.shear_ratio);
  EXPECT_EQ(law.friction, std::tan(card.contact_friction));
  EXPECT_EQ(law.damping_ratio, 0);
  const auto with = [&](const std::string& keys) {
    return read(edited("[[probe]]", "[impactor.contact]\n" + keys + "\n[[probe]]")).impactor->law;
  };
  const impact::ContactLaw hertz = with("spring = \"hertz\"\nfriction = 0.3\ndamping_ratio = 0.1");
  EXPECT_EQ(hertz.spring, impact::NormalSpring::hertz);
  EXPECT_NEAR(hertz.modulus, 30e9 / (1 - 0.04), 1);
  EXPECT_EQ(hertz.friction, 0.3);
  EXPECT_EQ(hertz.damping_ratio, 0.1);
  EXPECT_EQ(with("stiffness = \"0.5 kN/mm\"").stiffness, 0.5e6);
  EXPECT_EQ(with("modulus = \"2 GPa\"\nshear_ratio = 0").modulus, 2e9);
}

TEST_F(SceneFile, ReadsEveryShape) {
  const auto shape = [&](const std::string& measures) {
    return *read(edited(box_measures(), measures)).impactor;
  };
  const auto sphere = shape("shape = \"sphere\"\ndiameter = \"60 mm\"");
  EXPECT_NEAR(sphere.body.mass, 2500 * std::numbers::pi / 6 * std::pow(0.06, 3), 1e-12);
  const auto cylinder =
      shape("shape = \"cylinder\"\ndiameter = \"60 mm\"\nlength = \"0.2 m\"\nnose = \"hemisphere\"");
  EXPECT_EQ(std::get<impact::Cylinder>(cylinder.shape).nose, impact::Nose::hemisphere);
  const Scene stl = read(edited(box_measures(), "shape = \"mesh\"\nfile = \"rock.stl\"\nunit = \"mm\""));
  EXPECT_NEAR(stl.impactor->body.mass, 2.5, 1e-9);
  EXPECT_THAT(files_of(stl), ElementsAre(folder / "case.toml", folder / "card.toml", folder / "rock.stl"));
  EXPECT_EQ(read(edited("density = \"2500 kg/m3\"", "mass = \"3 kg\"")).impactor->body.mass, 3);
}

TEST_F(SceneFile, TurnsTheImpactor) {
  const auto approach = [&](const std::string& keys) {
    return read(edited("aim =", keys + "\naim =")).approach;
  };
  // Straight down, a box keeps its x along the structure's, whatever its sides are.
  EXPECT_TRUE((approach("").orientation * Vec3::UnitX()).isApprox(Vec3::UnitX(), 1e-14));
  EXPECT_TRUE((approach("").orientation * Vec3::UnitZ()).isApprox(-Vec3::UnitZ(), 1e-14));
  const Vec3 slanted = Vec3(1, 0, -2).normalized();
  const auto corner = approach("lead = \"corner\"\ndirection = [1, 0, -2]");
  EXPECT_TRUE(corner.direction.isApprox(slanted, 1e-14));
  EXPECT_TRUE((corner.orientation * Vec3::Ones().normalized()).isApprox(slanted, 1e-14));
  const auto turned = approach("turn = { axis = [0, 0, 2], angle = \"90 degree\" }");
  EXPECT_TRUE((turned.orientation * Vec3::UnitX()).isApprox(Vec3::UnitY(), 1e-14));
  const auto spinning = approach("spin = { axis = [0, 3, 0], period = \"20 ms\" }");
  EXPECT_TRUE(spinning.spin.isApprox(Vec3(0, 100 * std::numbers::pi, 0), 1e-12));
}

TEST_F(SceneFile, ReadsAMeshAndASpecimen) {
  const std::string mesh = "[mesh]\nfile = \"slab.msh\"\nunit = \"mm\"\nyoung_modulus = \"38 GPa\"";
  std::string text = edited("[mesh]\nelements = [20, 10, 4]", mesh);
  text.replace(text.find("layers = 3"), 10, "overlap = \"0.1 m\"");
  const Scene meshed = read(text);
  EXPECT_EQ(meshed.surroundings->mesh_file, folder / "slab.msh");
  EXPECT_EQ(meshed.surroundings->mesh_unit, 0.001);
  EXPECT_EQ(meshed.surroundings->overlap, 0.1);
  EXPECT_EQ(meshed.surroundings->young_modulus, 38e9);
  EXPECT_THAT(files_of(meshed), ElementsAre(folder / "case.toml", folder / "card.toml", folder / "slab.msh"));
  EXPECT_EQ(read(edited("[20, 10, 4]", "[20, 10, 4]\nmodulus = \"membrane\"")).surroundings->modulus,
            impact::PackModulus::membrane);
  const Scene packed = read(edited("elements = 12000\nseed = 7", "specimen = \"zone.h5\""));
  EXPECT_EQ(packed.structure.specimen, folder / "zone.h5");
  EXPECT_EQ(packed.structure.packing.elements, 2u);
  EXPECT_EQ(packed.seed, 5u);
}

TEST(SceneChecks, DistancePastIsThatOfConvexFigures) {
  impact::Approach approach;
  const Vec3 low(0, 0, 0), high(1, 1, 0.2);
  const impact::Shape sphere = impact::make_sphere(0.2, "");
  approach.aim = {1.5, 0.5, 7};
  EXPECT_NEAR(impact::distance_past(sphere, approach, low, high), 0.4, 1e-5) << "past a side";
  approach.aim = {1.3, 1.4, -7};
  EXPECT_NEAR(impact::distance_past(sphere, approach, low, high), 0.4, 1e-5) << "past a corner";
  approach.aim = {1.09, 0.5, 0};
  EXPECT_LT(impact::distance_past(sphere, approach, low, high), 0) << "grazing";
  approach.aim = {0.5, 0.5, 0.4};
  approach.direction = Vec3::UnitX();
  EXPECT_NEAR(impact::distance_past(sphere, approach, low, high), 0.1, 1e-5) << "over it";
  // A cube of 0.2 m that is turned by 45 degrees about its path reaches farther.
  const impact::Shape box = impact::make_box({0.2, 0.2, 0.2}, "");
  approach.orientation = Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitX());
  EXPECT_NEAR(impact::distance_past(box, approach, low, high), 0.2 - 0.1 * std::numbers::sqrt2, 1e-5);
}

TEST_F(SceneFile, RefusesInOneLine) {
  for (const auto& [from, to, message] : refusals())
    EXPECT_EQ(refusal(edited(from, to)), message) << from << " -> " << to;
}

TEST_F(SceneFile, NamesTheFileThatIsMissing) {
  EXPECT_THROW(impact::read_scene(folder / "none.toml"), dem::InputError);
  EXPECT_EQ(refusal("\n"),
            "case.toml: the file is empty; write the keys that are needed, one a line, as in E = \"30 GPa\"");
}

// The cases that come with the project, and the numbers that stand in their comments.
TEST(SceneCases, AreSound) {
  const fs::path cases = fs::path(SPALL_SOURCE_DIR) / "data/cases";
  const Scene whole = impact::read_scene(cases / "slab-paper-de.toml");
  const Scene coupled = impact::read_scene(cases / "slab-paper-coupled.toml");
  EXPECT_EQ(whole.structure.packing.elements, 120808u);
  EXPECT_EQ(coupled.structure.packing.elements, 120808u) << "from which the zone is cut";
  EXPECT_EQ(fe::box_mesh(coupled.surroundings->box).nodes.size(), 5830u);
  EXPECT_NEAR(whole.impactor->body.mass, 67.5, 1e-9);
  EXPECT_NEAR(whole.impactor->body.mass * whole.approach.speed * whole.approach.speed / 2, 54e3, 1e-6);
  EXPECT_EQ(whole.card.cohesion, 36e6);
  // The same but for the model.
  EXPECT_EQ(whole.approach.aim, coupled.approach.aim);
  EXPECT_EQ(whole.duration, coupled.duration);
  ASSERT_EQ(whole.supports.size(), coupled.supports.size());
  for (std::size_t k = 0; k < whole.supports.size(); ++k)
    EXPECT_EQ(whole.supports[k].high, coupled.supports[k].high);
  const Scene small = impact::read_scene(cases / "slab-small.toml");
  EXPECT_EQ(small.structure.packing.elements, 3000u);
  const Scene bar = impact::read_scene(cases / "bar-wave.toml");
  EXPECT_EQ(bar.approach.direction, Vec3::UnitX());
  EXPECT_NEAR(bar.surroundings->overlap, 0.15, 1e-15);
  EXPECT_EQ(dem::read_card(fs::path(SPALL_SOURCE_DIR) / "data/cards/paper-slab-co-3.6.toml").cohesion, 3.6e6);
}

TEST_F(SceneFile, DocumentedCasesAreSoundAndEveryKeyIsDocumented) {
  const std::string whole = content_of(fs::path(SPALL_SOURCE_DIR) / "docs/cases.md");
  const std::string page = whole.substr(whole.find("# Impact cases"));
  int blocks = 0;
  const std::string begin = "```toml\n";
  for (std::size_t at = 0; (at = page.find(begin, at)) != std::string::npos;) {
    at += begin.size();
    const std::string block = page.substr(at, page.find("\n```", at) + 1 - at);
    if (block.find("[impactor]") == std::string::npos) continue;
    EXPECT_EQ(refusal(block), "") << block;
    ++blocks;
  }
  EXPECT_GE(blocks, 1);
  const std::string stranger = "qqqqqqqqqqqqqqqqqq = 1\n";
  std::vector<std::string> lines{refusal(stranger + sound)};
  for (const char* table :
       {"[structure]", "[zone]", "[mesh]", "[coupling]", "[[support]]", "[impactor]", "[[probe]]", "[run]"})
    lines.push_back(refusal(edited(table + std::string("\n"), table + ("\n" + stranger))));
  lines.push_back(refusal(sound + "[output]\n" + stranger));
  lines.push_back(refusal(edited("[[probe]]", "[impactor.contact]\n" + stranger + "[[probe]]")));
  for (const std::string& line : lines) {
    const std::string mark = "unknown key; allowed: ";
    const auto at = line.find(mark);
    ASSERT_NE(at, std::string::npos) << line;
    std::istringstream keys(line.substr(at + mark.size()));
    for (std::string key; std::getline(keys >> std::ws, key, ',');)
      EXPECT_THAT(page, HasSubstr("`" + key + "`")) << line;
  }
}
