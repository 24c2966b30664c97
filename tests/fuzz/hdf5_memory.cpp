// HDF5 asks for half a megabyte for each file that it opens, which a sanitizer's allocator maps and unmaps at
// the system each time: kept in the library's own lists, it leaves two thirds of the time to the readers.
#include <hdf5.h>

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  constexpr int unlimited = -1;
  return H5set_free_list_limits(unlimited, unlimited, unlimited, unlimited, unlimited, unlimited) < 0 ? 1 : 0;
}
