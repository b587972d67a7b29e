// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Machines.h"

#include <algorithm>
#include <iterator>

namespace filament_core::conformance {
namespace {

constexpr const char* kWidth = "LP_NATIVE_VECTOR_WIDTH";
constexpr const char* kCaps = "GALLIUM_OVERRIDE_CPU_CAPS";

// How Mesa 22.3 interprets kCaps: src/util/u_cpu_detect.c.
constexpr SimulatedMachine kMachines[] = {
    { "width-128", { kWidth, "128" }, "", true, "Mesa's vectors have 4 lanes instead of 8" },
    { "width-256", { kWidth, "256" }, "", true, "nothing: the default, as a control" },
    { "width-512", { kWidth, "512" }, "", true, "nothing: the engine falls back to 256, Mesa crashes with 512" },
    { "caps-sse4.1", { kCaps, "sse4.1" }, "", false, "no AVX and no FMA: a product is rounded before it is added to" },
    { "caps-avx", { kCaps, "avx" }, "", true, "no AVX-512; Mesa leaves AVX2 and FMA" },
    { "caps-avx2", { kCaps, "avx2" }, "", true, "nothing: Mesa 22.3 to 26.1 do not know the word" },
    { "libm",
      { "GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F" },
      "",
      true,
      "the C library's functions without FMA: other last bits of sin, pow, ... of doubles" },
    { "emulated-haswell", {}, "Haswell", true, "an emulated Intel processor; estimate instructions are exact" },
    { "emulated-no-avx2", {}, "Haswell,-avx2", true, "the same with AVX and FMA, but without AVX2" },
};

} // namespace

std::vector<std::string> SimulatedMachine::launcher() const {
    if (!isEmulated()) return {};
    return { "qemu-x86_64", "-cpu", std::string(emulated) };
}

std::span<const SimulatedMachine> simulatedMachines() { return kMachines; }

SimulatedMachine const* findMachine(std::string_view name) {
    const auto found = std::ranges::find(kMachines, name, &SimulatedMachine::name);
    return found == std::end(kMachines) ? nullptr : found;
}

std::vector<std::string> quickMachines() {
    std::vector<std::string> names;
    for (SimulatedMachine const& machine : kMachines) {
        if (!machine.isEmulated()) names.emplace_back(machine.name);
    }
    return names;
}

} // namespace filament_core::conformance
