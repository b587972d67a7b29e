// SPDX-License-Identifier: Apache-2.0
#include "toolkit/machine/DriverPromise.h"

#include "toolkit/machine/Machine.h"

#include <fmt/format.h>

#include <compare>
#include <cstdio>
#include <optional>

namespace filament_core::tools {
namespace {

struct Version {
    int major = 0, minor = 0, patch = 0;
    auto operator<=>(Version const&) const = default;
};
constexpr Version kOldest{ 22, 3 }, kNewest{ 26, 1 }; // of those in the table of docs/drivers.md

std::string textOf(Version const& version) {
    return fmt::format("{}.{}.{}", version.major, version.minor, version.patch);
}

/// A release candidate has no patch number.
std::optional<Version> versionOf(std::string const& driver) {
    const size_t at = driver.find("Mesa ");
    Version version;
    if (at == std::string::npos) return {};
    if (std::sscanf(driver.c_str() + at, "Mesa %d.%d.%d", &version.major, &version.minor, &version.patch) < 2)
        return {};
    return version;
}

/// Of Mesa's CPU drivers; nothing for others.
std::optional<Version> cpuDriverVersion(DeviceDescription const& device) {
    return device.device.find("llvmpipe") == std::string::npos ? std::nullopt : versionOf(device.driver);
}

std::string noteOfAge(Version const& version) {
    const bool isOld = version < kOldest;
    const bool isNew = Version{ version.major, version.minor } > kNewest;
    if (!isOld && !isNew) return {};
    return fmt::format(
            "Mesa {} is {} than those that were measured, {}.{} to {}.{}: both APIs should draw the same bits, "
            "but nobody has looked; docs/drivers.md says how to",
            textOf(version), isOld ? "older" : "newer", kOldest.major, kOldest.minor, kNewest.major, kNewest.minor);
}

} // namespace

std::string mesaVersion(std::string_view driver) {
    const std::optional<Version> version = versionOf(std::string(driver));
    return version ? textOf(*version) : std::string();
}

std::string driverNote(std::span<const DeviceDescription> devices, std::string_view features) {
    std::optional<Version> first;
    for (DeviceDescription const& device : devices) {
        const std::optional<Version> version = cpuDriverVersion(device);
        if (!version)
            return fmt::format("{} ({}) may round as it likes: the same bits are promised for Mesa's CPU drivers "
                               "(mesa-vulkan-drivers, libgl1-mesa-dri)",
                               device.device, device.driver);
        if (first && *first != *version)
            return fmt::format("the APIs have drivers of Mesa {} and {}: the same bits are promised for one version; "
                               "upgrade mesa-vulkan-drivers and libgl1-mesa-dri together",
                               textOf(*first), textOf(*version));
        first = version;
    }
    if (!first) return {};
    if (std::string note = noteOfAge(*first); !note.empty()) return note;
    if (features == kPromisedFeatures) return {};
    return fmt::format(
            "this processor (or GALLIUM_OVERRIDE_CPU_CAPS) gives Mesa '{}' instead of '{}': both APIs draw the "
            "same bits, but not those of stored pictures",
            features, kPromisedFeatures);
}

} // namespace filament_core::tools
