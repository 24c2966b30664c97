// The table of docs/performance.md: `./dev bench`, or parts of it, `spall_performance links memory`.
#include <fmt/format.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/kernel_counts.h"
#include "bench/machine.h"
#include "bench/scenes.h"
#include "bench/table.h"
#include "bench/turns.h"
#include "calibrate/elastic_stage.h"
#include "libdem/core/error.h"
#include "libdem/drive/platens.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/probe/damage.h"
#include "specimens/specimen_file.h"
#include "specimens/virtual_tests/setup.h"
#include "tests/reference_loop.h"

namespace {

using namespace bench;
namespace fs = std::filesystem;

struct Wishes {
  bool quick = false;
  fs::path folder = "out/bench";
  std::string spall = SPALL_COMMAND, cases = SPALL_CASES;
};

const std::array sizes{small, medium, large};

std::string counted(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::ptrdiff_t k = std::ssize(text) - 3; k > 0; k -= 3) text.insert(static_cast<std::size_t>(k), 1, ',');
  return text;
}

/// Thousands of elements, enough for a measurement of a quarter of a second or so.
long steps_for(std::size_t links, bool quick) {
  return std::max(5L, (quick ? 4'000'000L : 30'000'000L) / static_cast<long>(links));
}

Row row_of(std::string part, std::string what, std::string unit, double goal, bool at_most,
           const std::vector<double>& values) {
  Row row;
  row.part = std::move(part), row.what = std::move(what), row.unit = std::move(unit);
  row.goal = goal, row.at_most = at_most;
  const Spread spread = spread_of(values);
  row.median = spread.median, row.low = spread.low, row.high = spread.high, row.turns = spread.turns;
  return row;
}

/// Million link updates a second of one core, at most: bytes over bandwidth, or operations over their rate.
double floor_rate(const Machine& machine, std::size_t elements, std::size_t links) {
  const double bytes = counts::bytes_per_link(elements, links);
  const double resident = counts::resident_per_link(elements, links) * static_cast<double>(links);
  const double seconds = std::max(bytes / machine.level_for(resident).bandwidth(),
                                  counts::operations_per_link(elements, links) / machine.operations);
  return 1e-6 / seconds;
}

/// A run from rest, warm: the turn starts with the first step that is timed.
struct WarmRun : Run {
  WarmRun(const dem::Assembly& start, int threads) : Run(start, pressing(threads)) { steps(3); }
};

void links(const Machine& machine, const Wishes& wishes, std::vector<Row>& rows) {
  const std::array goals{100.0, 80.0, 60.0};
  std::vector<Row> ratios;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const specimens::Specimen& specimen = specimen_of(sizes[k]).specimen;
    const dem::Assembly start = pressed(specimen);
    const auto count = specimen.links.size();
    const long steps = steps_for(count, wishes.quick), plain_steps = std::max(2L, steps / 4);
    std::vector<double> ours, ratio;
    for (int turn = 0; turn < (wishes.quick ? 3 : 9); ++turn) {
      WarmRun fast(start, 1);
      const double step = own_seconds_of([&] { fast.steps(steps); }) / static_cast<double>(steps);
      dem::Assembly plain = start;
      const auto plain_step = [&] {
        reference::step<dem::LinkChoices{}>(plain.law, plain.particles, plain.links, fast.options.time_step);
      };
      plain_step();
      const double slow = own_seconds_of([&] {
                            for (long s = 0; s < plain_steps; ++s) plain_step();
                          }) /
                          static_cast<double>(plain_steps);
      ours.push_back(1e-6 * static_cast<double>(count) / step);
      ratio.push_back(slow / step);
    }
    const std::string name = counted(sizes[k].elements) + " elements";
    rows.push_back(
        row_of("links", "link updates a second, one core, " + name, "million", goals[k], false, ours));
    rows.back().floor = floor_rate(machine, sizes[k].elements, count);
    ratios.push_back(row_of("links", "against the plain scalar loop, " + name, "times", 3.5, false, ratio));
  }
  rows.insert(rows.end(), ratios.begin(), ratios.end());
}

void threads(const Machine&, const Wishes& wishes, std::vector<Row>& rows) {
  for (const Size& size : {medium, large}) {
    const specimens::Specimen& specimen = specimen_of(size).specimen;
    const dem::Assembly start = pressed(specimen);
    const long steps = steps_for(specimen.links.size(), wishes.quick);
    std::vector<double> speedup;
    for (int turn = 0; turn < (wishes.quick ? 3 : 9); ++turn) {
      std::array<double, 2> seconds{};
      for (const int count : {1, 2}) {
        WarmRun run(start, count);
        seconds[static_cast<std::size_t>(count - 1)] = seconds_of([&] { run.steps(steps); });
      }
      speedup.push_back(seconds[0] / seconds[1]);
    }
    rows.push_back(row_of("threads", "two threads against one, " + counted(size.elements) + " elements",
                          "times", 1.85, false, speedup));
    rows.back().floor = 2;
  }
}

/// Slope of log(seconds) over log(elements), least squares.
double exponent_of(const std::vector<double>& elements, const std::vector<double>& seconds) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const double u = std::log(elements[k]), v = std::log(seconds[k]);
    x += u / n, y += v / n, xx += u * u / n, xy += u * v / n;
  }
  return (xy - x * y) / (xx - x * x);
}

void growth(const Machine&, const Wishes& wishes, std::vector<Row>& rows) {
  std::vector<Size> list{medium, large};
  if (!wishes.quick) list.push_back(million);
  std::vector<double> elements, exponents, rates;
  std::vector<dem::Assembly> starts;
  for (const Size& size : list) {
    const specimens::Specimen& specimen = specimen_of(size).specimen;
    starts.push_back(pressed(specimen));
    elements.push_back(static_cast<double>(size.elements));
  }
  for (int turn = 0; turn < (wishes.quick ? 2 : 5); ++turn) {
    std::vector<double> seconds;
    for (const dem::Assembly& start : starts) {
      WarmRun run(start, 1);
      const long steps = steps_for(start.links.count, wishes.quick);
      seconds.push_back(own_seconds_of([&] { run.steps(steps); }) / static_cast<double>(steps));
    }
    exponents.push_back(exponent_of(elements, seconds));
    rates.push_back(1e-6 * static_cast<double>(starts.back().links.count) / seconds.back());
  }
  rows.push_back(row_of("growth",
                        fmt::format("exponent of the time per step, 18,672 to {} elements, detection on",
                                    counted(list.back().elements)),
                        "", 1.05, true, exponents));
  rows.back().floor = 1;
  rows.back().remark = fmt::format("{:.0f} million link updates a second at {}", spread_of(rates).median,
                                   counted(list.back().elements));
}

/// A second detector, given the same positions at the same steps, is timed by itself: it does just what the one
/// inside the step does, which no clock disturbs.
void detection(const Machine&, const Wishes& wishes, std::vector<Row>& rows) {
  const Size& size = wishes.quick ? medium : large;
  Run run = impact_on(specimen_of(size).specimen);
  const double depth = 2 * specimen_of(size).specimen.element_size();
  run.steps(std::lround(depth / (impact_speed * run.options.time_step)));
  run.settle();
  const std::size_t broken = dem::broken_links(run.assembly.law, run.assembly.links);
  if (broken < 5000)
    throw dem::RunError(
        fmt::format("the impact has broken {} links only, which is no impact's middle", broken));

  dem::ContactDetector shadow(run.assembly.particles, run.assembly.links);
  shadow.restore(run.room.detector.memory());
  dem::Links contacts = run.assembly.contacts;
  const dem::Particles& particles = run.assembly.particles;
  const long steps = wishes.quick ? 60 : 200;
  std::vector<double> shares;
  const int before = shadow.rebuilds();
  for (int turn = 0; turn < (wishes.quick ? 3 : 7); ++turn) {
    double whole = 0, searching = 0;
    for (long s = 0; s < steps; ++s) {
      double square = 0;
      for (std::size_t i = 0; i < particles.count; ++i)
        square = std::max(square, particles.kinematics[i].velocity().squaredNorm());
      searching += own_seconds_of([&] {
        if (shadow.update(particles, contacts, std::sqrt(square), run.options.time_step))
          const dem::Incidence incidence(contacts, particles.count);
      });
      whole += own_seconds_of([&] { run.steps(1); });
    }
    shares.push_back(100 * searching / whole);
  }
  const long all_steps = steps * static_cast<long>(shares.size());
  const int rebuilds = shadow.rebuilds() - before;
  run.settle();
  rows.push_back(row_of(
      "detection", "contact detection's share of an impact's middle, " + counted(size.elements) + " elements",
      "%", 10, true, shares));
  rows.back().remark =
      fmt::format("{} to {} links broken, {} contacts listed, list renewed every {:.0f} steps", counted(broken),
                  counted(dem::broken_links(run.assembly.law, run.assembly.links)),
                  counted(run.assembly.contacts.count), static_cast<double>(all_steps) / std::max(1, rebuilds));
}

/// What this process grows by from loading the specimen to stepping, per link [bytes]. Runs alone in a process.
double memory_of(const fs::path& file) {
  const double before = resident_memory();
  const specimens::Specimen specimen = specimens::read_specimen(file);
  Run run(pressed(specimen), pressing(1));
  run.steps(20);
  return (resident_memory() - before) / static_cast<double>(specimen.links.size());
}

/// The first line that a command prints. Throws RunError if it fails.
std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw dem::RunError("cannot start " + command);
  std::array<char, 256> line{};
  std::string text = std::fgets(line.data(), line.size(), pipe) == nullptr ? "" : line.data();
  if (pclose(pipe) != 0) throw dem::RunError("failed: " + command);
  return text;
}

std::string this_program() { return fs::read_symlink("/proc/self/exe").string(); }

void memory(const Machine&, const Wishes& wishes, std::vector<Row>& rows) {
  const Size& size = wishes.quick ? medium : large;
  const specimens::Specimen& specimen = specimen_of(size).specimen;
  fs::create_directories(wishes.folder);
  const fs::path file = wishes.folder / "memory.h5";
  specimens::write_specimen(file, specimen);
  std::vector<double> bytes;
  for (int turn = 0; turn < (wishes.quick ? 1 : 5); ++turn)  // huge pages come or do not
    bytes.push_back(std::stod(output_of(fmt::format("'{}' --memory-of '{}'", this_program(), file.string()))));
  fs::remove(file);
  rows.push_back(row_of("memory", "memory a link, all included, " + counted(size.elements) + " elements",
                        "bytes", 250, true, bytes));
  rows.back().floor = counts::resident_per_link(size.elements, specimen.links.size());
}

void packing(const Machine&, const Wishes& wishes, std::vector<Row>& rows) {
  std::vector<std::pair<Size, double>> list{{large, 20}};
  if (!wishes.quick) list.emplace_back(million, 240);
  for (const auto& [size, goal] : list) {
    const Made& made = specimen_of(size);
    rows.push_back(row_of("packing", "packing and linking, two cores, " + counted(size.elements) + " elements",
                          "s", goal, true, {made.seconds}));
    rows.back().remark = fmt::format("{} links, process peak {:.0f} MB", counted(made.specimen.links.size()),
                                     made.peak_bytes / 1e6);
  }
}

void elastic(const Machine&, const Wishes& wishes, std::vector<Row>& rows) {
  const std::vector<specimens::Specimen> one{specimen_of(small).specimen};
  std::vector<double> seconds;
  for (int turn = 0; turn < (wishes.quick ? 2 : 7); ++turn)
    seconds.push_back(own_seconds_of([&] { calibrate::fit_elastic(one, 0.2, 1); }));
  rows.push_back(row_of("elastic", "elastic identification over nine Ks/Kn, 2,700 elements, one core", "s", 1,
                        true, seconds));
}

void paper_slab(const Machine&, const Wishes& wishes, std::vector<Row>& rows) {
  const fs::path folder = wishes.folder / "paper-slab";
  fs::remove_all(folder);  // its journal would answer in the tests' stead
  const std::string command =
      fmt::format("'{}' calibrate '{}/paper-slab.toml' -o '{}' --threads 2 > /dev/null 2> /dev/null",
                  wishes.spall, wishes.cases, folder.string());
  int status = 0;
  const double seconds = seconds_of([&] { status = std::system(command.c_str()); });
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code != 0 && code != 4) throw dem::RunError(fmt::format("exit code {} of {}", code, command));
  rows.push_back(row_of("paper-slab", "calibration of paper-slab, two cores", "s", 60, true, {seconds}));
}

/// What bench/peers/side_by_side.py has left, if it has run.
void yade(const Machine&, const Wishes& wishes, std::vector<Row>& rows) {
  const fs::path file = wishes.folder / "yade.json";
  std::ifstream stream(file);
  if (!stream) {
    fmt::print(stderr, "no {}: `./dev bench peers` measures against Yade\n", file.string());
    return;
  }
  const std::map<std::size_t, double> goals{{medium.elements, 30}, {large.elements, 25}};
  const nlohmann::json measured = nlohmann::json::parse(stream);
  for (const auto& one : measured.at("sizes")) {
    const auto elements = one.at("elements").get<std::size_t>();
    if (!goals.contains(elements)) continue;
    rows.push_back(row_of("yade", "against Yade CpmMat, one core, " + counted(elements) + " elements", "times",
                          goals.at(elements), false, one.at("ratio").get<std::vector<double>>()));
    rows.back().remark = fmt::format("Yade {:.2f} million", one.at("yade_million").get<double>());
  }
}

struct Part {
  const char* name;
  void (*measure)(const Machine&, const Wishes&, std::vector<Row>&);
  bool slow;  ///< left out of --quick
};
constexpr std::array parts{
    Part{"packing", packing, false}, Part{"links", links, false},     Part{"yade", yade, false},
    Part{"threads", threads, false}, Part{"growth", growth, false},   Part{"detection", detection, false},
    Part{"memory", memory, false},   Part{"elastic", elastic, false}, Part{"paper-slab", paper_slab, true}};

/// The elements and links of a specimen as text, for other codes: a line with the counts and the interaction
/// factor, then x y z radius vx vy vz held (1 if its motion along the load is prescribed), then pairs a b.
void export_text(const Size& size, const fs::path& file) {
  const specimens::Specimen& specimen = specimen_of(size).specimen;
  const dem::Assembly start = pressed(specimen);
  std::FILE* out = std::fopen(file.c_str(), "w");
  if (out == nullptr) throw dem::RunError("cannot write " + file.string());
  const int axis = specimen.long_axis();
  fmt::print(out, "{} {} {:.17g} {}\n", specimen.elements(), specimen.links.size(),
             specimen.interaction_radius_factor, axis);
  const dem::Platens platens =
      dem::find_platens(start.particles, axis, specimen.size[axis], specimen.element_size());
  std::vector<int> held(specimen.elements(), 0);
  for (const auto* layer : {&platens.low, &platens.high})
    for (const std::int32_t i : *layer) held[static_cast<std::size_t>(i)] = 1;
  for (std::size_t i = 0; i < specimen.elements(); ++i) {
    const dem::Vec3& x = specimen.centres[i];
    const dem::Vec3 v = start.particles.kinematics[i].velocity();
    fmt::print(out, "{:.17g} {:.17g} {:.17g} {:.17g} {:.9g} {:.9g} {:.9g} {}\n", x.x(), x.y(), x.z(),
               specimen.radii[i], v.x(), v.y(), v.z(), held[i]);
  }
  for (const specimens::Link& link : specimen.links) fmt::print(out, "{} {}\n", link.a, link.b);
  if (std::fclose(out) != 0) throw dem::RunError("cannot write " + file.string());
}

/// Answers lines "steps" on standard input with "seconds" that so many steps took: turns with another code.
void serve(const Size& size) {
  const dem::Assembly start = pressed(specimen_of(size).specimen);
  fmt::print("ready {}\n", start.links.count);
  std::fflush(stdout);
  for (long steps = 0; std::cin >> steps;) {
    WarmRun run(start, 1);
    fmt::print("seconds {:.9g}\n", own_seconds_of([&] { run.steps(steps); }));
    std::fflush(stdout);
  }
}

const Size& size_of(std::size_t elements) {
  for (const Size& size : sizes)
    if (size.elements == elements) return size;
  throw dem::InputError("elements", std::to_string(elements), "allowed: 2700, 18672, 120808");
}

int run(int count, char** arguments) {
  CLI::App command("Measures what docs/performance.md promises, and the machine's floor under it");
  Wishes wishes;
  std::vector<std::string> wanted, names;
  for (const Part& part : parts) names.emplace_back(part.name);
  std::size_t served = 0, exported = 0;
  fs::path file, memory_file;
  command.add_option("part", wanted, "parts to run; all by default")->check(CLI::IsMember(names));
  command.add_flag("--quick", wishes.quick, "fewer turns, no million elements, no calibration");
  command.add_option("-o,--output", wishes.folder, "folder for table.md and table.json")->capture_default_str();
  command.add_option("--export", exported, "only write this specimen as text to --to: 2700, 18672, 120808");
  command.add_option("--to", file, "file of --export");
  command.add_option("--serve", served, "only step this specimen, in turns with another code");
  command.add_option("--memory-of", memory_file, "only print the memory that a specimen takes [bytes a link]");
  CLI11_PARSE(command, count, arguments);

  if (exported != 0) return export_text(size_of(exported), file), 0;
  if (served != 0) return serve(size_of(served)), 0;
  if (!memory_file.empty()) return fmt::print("{:.9g}\n", memory_of(memory_file)), 0;

  const Machine machine = measure_machine(wishes.quick);
  std::vector<Row> rows;
  for (const Part& part : parts) {
    const bool asked = std::find(wanted.begin(), wanted.end(), part.name) != wanted.end();
    if (!asked && (!wanted.empty() || (wishes.quick && part.slow))) continue;
    fmt::print(stderr, "{} ...\n", part.name);
    part.measure(machine, wishes, rows);
  }
  fmt::print("{}", to_markdown(rows, machine));
  write_table(wishes.folder, rows, machine);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run(count, arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "spall_performance: {}\n", error.what());
    return 1;
  }
}
