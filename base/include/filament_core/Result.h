// SPDX-License-Identifier: Apache-2.0
/// Result: a value, or the reason why there is none.
///   Use     for everything that can fail outside the program: a file, a package, a device. A bug of the caller is an
///           assertion instead (base/Assert.h).
///   Thread  a plain value; no sharing, no locks.
///   Errors  `message` is one line that names what failed, where (file, line, element) and how to fix it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace filament_core {

enum class ErrorCode : uint8_t {
    InvalidArgument,   ///< a value outside its documented range
    NotFound,          ///< no such file, device, parameter
    Unreadable,        ///< it exists but cannot be read or written
    Corrupt,           ///< it was read but violates its own format
    Unsupported,       ///< well formed, but not something this build or device can do
    DeviceUnavailable, ///< no driver, or no device of that name
    DeviceLost,        ///< the device was there and went away
    OutOfMemory,       ///< host or device memory exhausted
    Timeout,           ///< gave up waiting
    Cancelled,         ///< the program requested its end
    Internal,          ///< a bug in this library: please report it
};

/// The code as text, such as "not found"; never empty.
const char* toString(ErrorCode code);

struct Error {
    ErrorCode code = ErrorCode::Internal;
    std::string message;
};

namespace detail {
/// End the process in every build, with the message of the error that was not looked at.
[[noreturn]] void valueOfError(Error const& error);
[[noreturn]] void errorOfValue();
} // namespace detail

/// Holds a T or an Error. Reading the one that is absent ends the process, in every build.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : mState(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : mState(std::in_place_index<1>, std::move(error)) {}

    bool ok() const { return mState.index() == 0; }
    explicit operator bool() const { return ok(); }

    T& value() & {
        require();
        return std::get<0>(mState);
    }
    T const& value() const& {
        require();
        return std::get<0>(mState);
    }
    T&& value() && {
        require();
        return std::get<0>(std::move(mState));
    }
    T& operator*() & { return value(); }
    T const& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    T const* operator->() const { return &value(); }

    Error const& error() const {
        if (ok()) detail::errorOfValue();
        return std::get<1>(mState);
    }

private:
    void require() const {
        if (!ok()) detail::valueOfError(std::get<1>(mState));
    }

    std::variant<T, Error> mState;
};

/// Success without a value: `Result<void>{}`.
template <>
class [[nodiscard]] Result<void> {
public:
    Result() = default;
    Result(Error error) : mError(std::move(error)), mOk(false) {}

    bool ok() const { return mOk; }
    explicit operator bool() const { return mOk; }
    Error const& error() const {
        if (mOk) detail::errorOfValue();
        return mError;
    }

private:
    Error mError;
    bool mOk = true;
};

} // namespace filament_core
