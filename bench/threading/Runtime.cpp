// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/Runtime.h"

namespace filament_core::bench {

const char* toString(RuntimeKind kind) {
    switch (kind) {
    case RuntimeKind::Ours:
        return "ours";
    case RuntimeKind::OneTbb:
        return "tbb";
    case RuntimeKind::OpenMp:
        return "openmp";
    case RuntimeKind::StdAsync:
        return "async";
    case RuntimeKind::Serial:
        return "serial";
    }
    return "?";
}

std::unique_ptr<Runtime> makeRuntime(RuntimeKind kind, RuntimeOptions const& options) {
    switch (kind) {
    case RuntimeKind::Ours:
        return makeOursRuntime(options);
    case RuntimeKind::OneTbb:
        return makeOneTbbRuntime(options);
    case RuntimeKind::OpenMp:
        return makeOpenMpRuntime(options);
    case RuntimeKind::StdAsync:
        return makeStdAsyncRuntime(options);
    case RuntimeKind::Serial:
        break;
    }
    return makeSerialRuntime();
}

} // namespace filament_core::bench
