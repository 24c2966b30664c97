// Columns of numbers that start on a cache line, so that lanes of them can be loaded whole.
#pragma once
#include <cstddef>
#include <vector>

namespace dem {

/// Memory that starts on a cache line; large pieces lie in huge pages where the system grants them. Throws
/// std::bad_alloc.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* memory, std::size_t bytes);

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}  // NOLINT: allocators convert implicitly
  T* allocate(std::size_t count) { return static_cast<T*>(allocate_aligned(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) { free_aligned(memory, count * sizeof(T)); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

template <class T>
using Column = std::vector<T, CacheLineAllocator<T>>;

}  // namespace dem
