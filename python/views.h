// numpy arrays that look into C++ memory: nothing is copied, and the array keeps the owner of the memory alive.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <type_traits>
#include <vector>

#include "libdem/core/vector.h"

namespace python {

/// A read-only array on `data`. Strides in bytes. `owner` is the Python object that the memory belongs to.
template <class T>
pybind11::array view(const T* data, std::vector<pybind11::ssize_t> shape,
                     std::vector<pybind11::ssize_t> strides, pybind11::handle owner) {
  pybind11::array array(pybind11::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
  pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// (n,) of plain numbers.
template <class T>
pybind11::array view(const std::vector<T>& values, pybind11::handle owner) {
  return view(values.data(), {static_cast<pybind11::ssize_t>(values.size())}, {sizeof(T)}, owner);
}

/// (n, 3) of vectors.
inline pybind11::array view(const std::vector<dem::Vec3>& values, pybind11::handle owner) {
  static_assert(sizeof(dem::Vec3) == 3 * sizeof(double));
  return view(values.empty() ? nullptr : values.front().data(),
              {static_cast<pybind11::ssize_t>(values.size()), 3}, {sizeof(dem::Vec3), sizeof(double)}, owner);
}

/// (n,) of one member of structures that stand one after the other.
template <class Row, class T>
pybind11::array view(const std::vector<Row>& rows, T Row::*member, pybind11::handle owner) {
  return view(rows.empty() ? nullptr : &(rows.front().*member), {static_cast<pybind11::ssize_t>(rows.size())},
              {sizeof(Row)}, owner);
}

/// An array of its own.
template <class T>
pybind11::array copy(const std::vector<T>& values) {
  return pybind11::array(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

inline pybind11::array copy(const std::vector<dem::Vec3>& values) {
  return pybind11::array(pybind11::dtype::of<double>(),
                         {static_cast<pybind11::ssize_t>(values.size()), pybind11::ssize_t{3}},
                         values.empty() ? nullptr : values.front().data());
}

}  // namespace python
