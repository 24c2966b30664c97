#include "libdem/io/hdf5.h"
#include "specimens/specimen_file.h"
#include "tests/fuzz/feeds.h"
#include "tests/fuzz/scratch_folder.h"

void fuzz::specimen(std::string_view bytes) {
  take_refusal([&] { specimens::read_specimen(dem::Hdf5File::open_image(bytes, "s.h5")); });
}
