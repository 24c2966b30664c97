// HDF5 files: what goes in comes out; what is wrong is said in one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "libdem/core/child_process.h"
#include "libdem/core/error.h"
#include "libdem/core/sha256.h"
#include "libdem/io/hdf5.h"

using dem::Hdf5File;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

class Hdf5 : public testing::Test {
 protected:
  Hdf5() { std::filesystem::create_directories(folder); }
  ~Hdf5() override { std::filesystem::remove_all(folder); }
  std::filesystem::path file(const std::string& name) const { return folder / name; }

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() /
      (std::string("spall-hdf5-test-") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

template <class Action>
std::string refusal(Action&& action) {
  try {
    action();
  } catch (const dem::InputError& error) {
    return error.what();
  }
  return "(accepted)";
}

void write_example(const std::filesystem::path& file, int version = 1) {
  dem::create_spall_file(file, "spall-specimen", version, [](Hdf5File& out) {
    std::vector<double> positions(30000);
    std::iota(positions.begin(), positions.end(), 0.5);
    out.write("elements/position", positions, 3);
    out.write("packed", positions, 3, {.gzip = 4});
    out.write("elements/id", std::vector<std::int32_t>{1, -2, 3});
    out.write("many", std::vector<std::int64_t>{1ll << 40});
    out.write("flags", std::vector<std::uint8_t>{0, 255});
    out.write("single", std::vector<float>{1.5f});
    out.write("nothing", std::vector<double>{});
    out.set_attribute("/", "name", "grès à 3 €");
    out.set_attribute("elements", "radius", 0.25);
    out.set_attribute("elements", "seed", std::uint64_t{0xffffffffffffffffull});
    const std::vector<std::int64_t> numbers{1, 8};
    out.set_attribute("/", "Version", std::span<const std::int64_t>(numbers));
  });
}

}  // namespace

TEST_F(Hdf5, ReturnsWhatWasWritten) {
  write_example(file("a.h5"));
  const Hdf5File in = dem::open_spall_file(file("a.h5"), "spall-specimen", 1);
  EXPECT_THAT(in.shape("elements/position"), ElementsAre(10000, 3));
  EXPECT_EQ(in.read<double>("elements/position", 3)[29999], 29999.5);
  EXPECT_EQ(in.read<double>("packed", 3, 10000), in.read<double>("elements/position", 3));
  EXPECT_THAT(in.read<std::int32_t>("elements/id"), ElementsAre(1, -2, 3));
  EXPECT_THAT(in.read<std::int64_t>("elements/id"), ElementsAre(1, -2, 3));
  EXPECT_THAT(in.read<std::int64_t>("many"), ElementsAre(1ll << 40));
  EXPECT_THAT(in.read<std::uint8_t>("flags"), ElementsAre(0, 255));
  EXPECT_THAT(in.read<float>("single"), ElementsAre(1.5f));
  EXPECT_TRUE(in.read<double>("nothing").empty());
  EXPECT_EQ(in.text_attribute("/", "name"), "grès à 3 €");
  EXPECT_EQ(in.number_attribute<double>("elements", "radius"), 0.25);
  EXPECT_EQ(in.number_attribute<std::uint64_t>("elements", "seed"), 0xffffffffffffffffull);
  EXPECT_THAT(in.numbers_attribute<std::int64_t>("/", "Version"), ElementsAre(1, 8));
  EXPECT_TRUE(in.has("elements"));
  EXPECT_FALSE(in.has("elements/nowhere/position"));
  EXPECT_THAT(in.names_in("elements"), ElementsAre("id", "position"));
}

TEST_F(Hdf5, SameContentGivesTheSameBytes) {
  write_example(file("a.h5"));
  write_example(file("b.h5"));
  EXPECT_EQ(dem::sha256_of_file(file("a.h5")), dem::sha256_of_file(file("b.h5")));
}

TEST_F(Hdf5, NamesWhatIsWrongInside) {
  write_example(file("a.h5"));
  const Hdf5File in = Hdf5File::open(file("a.h5"));
  EXPECT_THAT(refusal([&] { in.read<double>("radius"); }),
              AllOf(HasSubstr("a.h5"), HasSubstr("radius"), HasSubstr("missing")));
  EXPECT_THAT(refusal([&] { in.read<double>("elements"); }), HasSubstr("dataset elements"));
  EXPECT_THAT(refusal([&] { in.read<double>("elements/position"); }), HasSubstr("(10000, 3) instead of (any)"));
  EXPECT_THAT(refusal([&] { in.read<double>("elements/position", 3, 7); }), HasSubstr("instead of (7, 3)"));
  EXPECT_THAT(refusal([&] { in.read<std::int32_t>("many"); }), HasSubstr("another type"));
  EXPECT_THAT(refusal([&] { in.read<double>("many"); }), HasSubstr("another type"));
  EXPECT_THAT(refusal([&] { in.text_attribute("elements", "radius"); }), HasSubstr("not a text"));
  EXPECT_THAT(refusal([&] { in.number_attribute<double>("elements", "mass"); }),
              HasSubstr("attribute mass of elements"));
  EXPECT_THAT(refusal([&] { in.number_attribute<std::int64_t>("/", "Version"); }), HasSubstr("not one number"));
}

TEST_F(Hdf5, RefusesOtherKindsOfFiles) {
  EXPECT_THAT(refusal([&] { Hdf5File::open(file("none.h5")); }), HasSubstr("no such file"));
  EXPECT_THAT(refusal([&] { Hdf5File::open(folder); }), HasSubstr("not a file"));
  std::ofstream(file("text.h5")) << "hello";
  EXPECT_THAT(refusal([&] { Hdf5File::open(file("text.h5")); }), HasSubstr("is not an HDF5 file"));
  write_example(file("a.h5"));
  EXPECT_THAT(refusal([&] { dem::open_spall_file(file("a.h5"), "spall-checkpoint", 1); }),
              HasSubstr("is a spall-specimen file, not a spall-checkpoint file"));
  write_example(file("new.h5"), 3);
  EXPECT_THAT(refusal([&] { dem::open_spall_file(file("new.h5"), "spall-specimen", 2); }),
              HasSubstr("version 3"));
  Hdf5File::create(file("foreign.h5")).close();
  EXPECT_THAT(refusal([&] { dem::open_spall_file(file("foreign.h5"), "spall-specimen", 1); }),
              HasSubstr("not a spall-specimen file"));
}

TEST_F(Hdf5, RefusesTruncatedFilesAtAnyLength) {
  write_example(file("a.h5"));
  const auto whole = std::filesystem::file_size(file("a.h5"));
  for (const std::uintmax_t length :
       {std::uintmax_t{0}, std::uintmax_t{7}, std::uintmax_t{600}, whole / 2, whole - 1}) {
    std::filesystem::copy_file(file("a.h5"), file("cut.h5"), std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(file("cut.h5"), length);
    EXPECT_THAT(refusal([&] { Hdf5File::open(file("cut.h5")); }), HasSubstr("cut.h5")) << length;
  }
}

TEST_F(Hdf5, ReadsBytesInMemoryAsTheFileThatTheyAre) {
  write_example(file("a.h5"));
  std::ifstream in(file("a.h5"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const Hdf5File opened = Hdf5File::open_image(bytes, "memory.h5");
  EXPECT_EQ(opened.text_attribute("/", "format"), "spall-specimen");
  EXPECT_EQ(opened.names_in("/"), Hdf5File::open(file("a.h5")).names_in("/"));
  EXPECT_THAT(refusal([&] { Hdf5File::open_image("hello", "memory.h5"); }), HasSubstr("memory.h5"));
  EXPECT_THAT(refusal([&] { Hdf5File::open_image("", "memory.h5"); }), HasSubstr("memory.h5"));
}

// Without their checksums a damaged length is believed, and the library reads behind its buffers.
TEST_F(Hdf5, ASpallFileKnowsWhenItsHeadersAreDamaged) {
  dem::create_spall_file(file("a.h5"), "spall-test", 1, [](Hdf5File& out) {
    out.set_attribute("/", "words", "as they were");
    out.write("group/numbers", std::vector<double>{1, 2, 3});
  });
  std::ifstream in(file("a.h5"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::size_t words = bytes.find("as they were");
  ASSERT_NE(words, std::string::npos);
  for (std::size_t k = 0; k < std::string_view("as they were").size(); ++k) {
    std::string damaged = bytes;
    damaged[words + k] ^= 1;
    EXPECT_THROW(Hdf5File::open_image(damaged, "a.h5").text_attribute("/", "words"), dem::InputError) << k;
  }
}

TEST_F(Hdf5, DamageInTheOlderFormOfFilesIsRefusedWhereTheLibraryWouldCrash) {
  const auto path = file("older.h5");
  {
    Hdf5File out = Hdf5File::create(path);
    out.write("elements/radius", std::vector<double>{1, 2, 3});
    for (const char* name : {"format", "name", "mixture"}) out.set_attribute("/", name, std::string(40, 'a'));
    out.set_attribute("elements", "seed", 7.0);
    out.close();
  }
  std::ifstream in(path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  ASSERT_EQ(whole[8], 0) << "not the older form";
  EXPECT_EQ(Hdf5File::open(path).number_attribute<double>("elements", "seed"), 7);
#if !defined(SPALL_SANITIZED)  // where the child's memory cannot be limited
  // The list of free places behind the names of "elements" made to run in a circle: HDF5 1.10 would follow it
  // until no memory is left.
  std::string circle = whole;
  const std::size_t list = whole.find("radius") + 8;
  ASSERT_EQ(circle[list], 1);
  circle[list] = 16;
  std::ofstream(path, std::ios::binary) << circle;
  EXPECT_THAT(refusal([&] { Hdf5File::open(path); }), HasSubstr("so damaged that the library"));
#endif
  int refused = 0, tried = 0;
  for (std::size_t at = 9; at < whole.size(); at += 7) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(0xE1);
    std::ofstream(path, std::ios::binary) << damaged;
    ++tried;
    refused += refusal([&] {
                 const Hdf5File opened = Hdf5File::open(path);
                 opened.has_attribute("/", "none");
                 opened.text_attribute("/", "name");
                 opened.number_attribute<double>("elements", "seed");
                 opened.read<double>("elements/radius");
               }) != "(accepted)";
  }
  EXPECT_GT(refused, tried / 50);
}

TEST_F(Hdf5, LeavesTheOldFileWhenWritingFails) {
  write_example(file("a.h5"));
  const auto before = dem::sha256_of_file(file("a.h5"));
  EXPECT_THROW(dem::create_spall_file(file("a.h5"), "x", 1,
                                      [](Hdf5File& out) { out.write("ragged", std::vector<double>(7), 3); }),
               dem::RunError);
  EXPECT_THROW(Hdf5File::create(file("nowhere/a.h5")), dem::RunError);
  EXPECT_EQ(dem::sha256_of_file(file("a.h5")), before);
}

TEST_F(Hdf5, AProcessStartedWhileAFileIsWrittenDoesNotKeepItFromReaders) {
  Hdf5File out = Hdf5File::create(file("a.h5"), true);
  out.write("values", std::vector<double>{1, 2, 3});
  const pid_t child = dem::start_child([] { ::pause(); });
  out.close();
  EXPECT_NO_THROW(Hdf5File::open(file("a.h5")));
  ::kill(child, SIGKILL);
  EXPECT_FALSE(dem::wait_for_child(child).crash.empty());
}
