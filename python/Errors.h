// SPDX-License-Identifier: Apache-2.0
/// Errors: the engine's errors as exceptions of Python, with its messages.
///   Classes  Error, and one below it for each kind that a program may want to tell apart; each also derives from the
///            built-in exception that it resembles (ValueError, LookupError, OSError, MemoryError, RuntimeError).
///   Thread   one that holds the interpreter's lock (GIL).
#pragma once

#include "base/Result.h"

#include <pybind11/pybind11.h>

#include <string_view>
#include <utility>

namespace filament_core::python {

namespace py = pybind11;

/// Adds the classes to the module. First of all: the other functions need them.
void bindErrors(py::module_& module);

/// Sets the exception of the error's code, and throws it through C++.
[[noreturn]] void raise(Error const& error);
/// ThreadError: another thread than the engine's, or another call is still at work.
[[noreturn]] void raiseThreadError(std::string_view message);
/// ClosedError: what is used is gone, because its engine was closed or it was removed from its scene.
[[noreturn]] void raiseClosedError(std::string_view message);

template <class... Args>
[[noreturn]] void raiseInvalid(fmt::format_string<Args...> format, Args&&... args) {
    raise({ ErrorCode::InvalidArgument, fmt::vformat(format, fmt::make_format_args(args...)) });
}

template <class T>
T valueOf(Result<T>&& result) {
    if (!result) raise(result.error());
    return *std::move(result);
}

inline void check(Result<void> const& result) {
    if (!result) raise(result.error());
}

} // namespace filament_core::python
