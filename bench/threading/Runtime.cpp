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
    case RuntimeKind::Eigen:
        return "eigen";
    case RuntimeKind::Asio:
        return "asio";
    case RuntimeKind::StdAsync:
        return "async";
    case RuntimeKind::Serial:
        return "serial";
    }
    return "?";
}

bool isBuilt(RuntimeKind kind) {
    if (kind == RuntimeKind::Eigen) return FILAMENT_BENCH_HAS_EIGEN != 0;
    if (kind == RuntimeKind::Asio) return FILAMENT_BENCH_HAS_ASIO != 0;
    return true;
}

std::string absentRuntimes() {
    std::string absent;
    if (!isBuilt(RuntimeKind::Eigen)) absent += "eigen (libeigen3-dev)";
    if (!isBuilt(RuntimeKind::Asio)) absent += absent.empty() ? "asio (libboost-dev)" : ", asio (libboost-dev)";
    return absent;
}

const char* whyLeftOut(RuntimeKind kind, Work work) {
    if (kind != RuntimeKind::Eigen) return nullptr;
    switch (work) {
    case Work::Tree:
        return "a job that waits blocks its thread: a few forks stop the pool for ever";
    case Work::Chain:
        return "a job cannot return its successor; it can start it, which is the relay";
    case Work::Graph:
        return "jobs have no dependencies";
    default:
        return nullptr;
    }
}

std::unique_ptr<Runtime> makeRuntime(RuntimeKind kind, RuntimeOptions const& options) {
    switch (kind) {
    case RuntimeKind::Ours:
        return makeOursRuntime(options);
    case RuntimeKind::OneTbb:
        return makeOneTbbRuntime(options);
    case RuntimeKind::OpenMp:
        return makeOpenMpRuntime(options);
#if FILAMENT_BENCH_HAS_EIGEN
    case RuntimeKind::Eigen:
        return makeEigenRuntime(options);
#endif
#if FILAMENT_BENCH_HAS_ASIO
    case RuntimeKind::Asio:
        return makeAsioRuntime(options);
#endif
    case RuntimeKind::StdAsync:
        return makeStdAsyncRuntime(options);
    default:
        break;
    }
    return makeSerialRuntime();
}

} // namespace filament_core::bench
