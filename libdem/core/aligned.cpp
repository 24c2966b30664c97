#include "libdem/core/aligned.h"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace dem {
namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21;

/// The loop over links reads elements here and there: with pages of 4 kB it would wait for their addresses.
std::align_val_t alignment_for(std::size_t bytes) {
  return static_cast<std::align_val_t>(bytes >= huge_page ? huge_page : 64);
}

}  // namespace

void* allocate_aligned(std::size_t bytes) {
  void* memory = ::operator new(bytes, alignment_for(bytes));
#ifdef __linux__
  // A wish, small pages do as well; and for whole huge pages only, so that the last one is not rounded up.
  if (bytes >= huge_page) madvise(memory, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_aligned(void* memory, std::size_t bytes) { ::operator delete(memory, alignment_for(bytes)); }

}  // namespace dem
