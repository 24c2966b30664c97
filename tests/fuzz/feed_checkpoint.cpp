#include <optional>

#include "libdem/run/checkpoint.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/seal.h"
#include "tests/verification/scene.h"

// Into an assembly of three elements and two links, which belongs to nothing.
void fuzz::checkpoint(std::string_view bytes) {
  struct State {
    dem::Assembly assembly = scene::chain(3, scene::plain_law());
    dem::StepRoom room{assembly};
  };
  // What is refused leaves it as it was.
  static std::optional<State> state;
  read_sealed(bytes, "checkpoint.h5", [](const dem::Hdf5File& file) {
    if (!state) state.emplace();
    dem::read_checkpoint(file, {}, state->assembly, state->room);
    state.reset();
  });
}
