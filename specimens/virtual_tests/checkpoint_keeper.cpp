#include "specimens/virtual_tests/checkpoint_keeper.h"

#include <fmt/format.h>

#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/core/sha256.h"

namespace virtual_tests {

std::string sha256_of(const dem::MaterialCard& card) { return dem::sha256_of(dem::identity_text(card)); }

CheckpointKeeper::CheckpointKeeper(const CheckpointPolicy& policy, dem::Belonging belonging)
    : wanted(policy), belongs_to(std::move(belonging)), pace(policy.seconds_between) {}

std::optional<dem::NamedNumbers> CheckpointKeeper::restore(dem::Assembly& assembly, dem::StepRoom& room) const {
  if (!wanted.resume || wanted.file.empty() || !std::filesystem::exists(wanted.file)) return {};
  return dem::read_checkpoint(wanted.file, belongs_to, assembly, room);
}

void CheckpointKeeper::look(dem::Assembly& assembly, const dem::StepRoom& room, long steps,
                            const std::function<dem::NamedNumbers()>& numbers) {
  const bool stop = dem::interrupt_requested() || steps == wanted.stop_after;
  if (!wanted.file.empty() && (stop || pace.is_due()))
    pace.keep([&] { dem::write_checkpoint(wanted.file, belongs_to, assembly, room, numbers()); });
  if (!stop) return;
  throw dem::Interrupted(wanted.file.empty() ? "stopped by a signal"
                                             : fmt::format("stopped by a signal at step {}", steps));
}

const std::vector<double>& column_of(const dem::NamedNumbers& numbers, const std::string& name,
                                     const std::filesystem::path& file, bool may_be_empty) {
  const auto found = numbers.find(name);
  if (found == numbers.end() || (found->second.empty() && !may_be_empty))
    throw dem::InputError(file.string(), fmt::format("lacks the number {}", name),
                          "start anew without --resume");
  return found->second;
}

}  // namespace virtual_tests
