// SPDX-License-Identifier: Apache-2.0
#include "base/Result.h"

namespace filament_core {

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
