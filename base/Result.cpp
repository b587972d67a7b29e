// SPDX-License-Identifier: Apache-2.0
#include "base/Result.h"

#include "base/ApiCall.h"

#include <string>

namespace filament_core {
namespace detail {

void valueOfError(Error const& error) {
    misused("Result::value(): there is none, but an error (" + std::string(toString(error.code)) +
            "): " + error.message);
}
void errorOfValue() { misused("Result::error(): there is none, the call succeeded"); }

} // namespace detail

const char* toString(ErrorCode code) {
    switch (code) {
    case ErrorCode::InvalidArgument:
        return "invalid argument";
    case ErrorCode::NotFound:
        return "not found";
    case ErrorCode::Unreadable:
        return "unreadable";
    case ErrorCode::Corrupt:
        return "corrupt";
    case ErrorCode::Unsupported:
        return "unsupported";
    case ErrorCode::DeviceUnavailable:
        return "device unavailable";
    case ErrorCode::DeviceLost:
        return "device lost";
    case ErrorCode::OutOfMemory:
        return "out of memory";
    case ErrorCode::Timeout:
        return "timeout";
    case ErrorCode::Cancelled:
        return "cancelled";
    case ErrorCode::Internal:
        return "internal error";
    }
    return "unknown error";
}

} // namespace filament_core
