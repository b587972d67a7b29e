// SPDX-License-Identifier: Apache-2.0
#include "backend/create/MesaEnvironment.h"

#include "base/Log.h"

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string_view>

namespace filament_core::backend {
namespace {

constexpr const char* kWidth = "LP_NATIVE_VECTOR_WIDTH";
constexpr const char* kCacheDirectory = "MESA_SHADER_CACHE_DIR";
constexpr const char* kDefaultWidth = "256";
constexpr const char* kOptions = "GALLIVM_PERF";
constexpr const char* kFloatFilters = "no_aos_sampling";
constexpr std::string_view kOwnFolder = "/mesa_vectors_128";

using Lookup = std::function<const char*(const char*)>;

/// Where Mesa looks for its cache, in its order of preference. No value: the location is unknown.
std::optional<std::string> cacheOf(Lookup const& lookup) {
    for (const char* name : { kCacheDirectory, "XDG_CACHE_HOME" }) {
        if (const char* value = lookup(name); value && *value) return value;
    }
    const char* home = lookup("HOME");
    return home && *home ? std::optional(std::string(home) + "/.cache") : std::nullopt;
}

EnvironmentChange ownCache(Lookup const& lookup) {
    const auto cache = cacheOf(lookup);
    if (!cache) return { "MESA_SHADER_CACHE_DISABLE", "true" };
    const bool isOwn = cache->ends_with(kOwnFolder); // set by a parent process
    return { kCacheDirectory, isOwn ? *cache : *cache + std::string(kOwnFolder) };
}

/// Leaves the folder that a parent process of 128 bits left in the environment.
void leaveOwnCache(Lookup const& lookup, std::vector<EnvironmentChange>& changes) {
    const char* const value = lookup(kCacheDirectory);
    std::string_view cache = value ? value : "";
    if (!cache.ends_with(kOwnFolder)) return;
    cache.remove_suffix(kOwnFolder.size());
    changes.push_back({ kCacheDirectory, std::string(cache) });
}

/// Mesa separates its options by commas.
void filterInFloatingPoint(Lookup const& lookup, std::vector<EnvironmentChange>& changes) {
    const char* const value = lookup(kOptions);
    const std::string_view options = value ? value : "";
    if (options.find(kFloatFilters) != std::string_view::npos) return;
    changes.push_back({ kOptions, options.empty() ? kFloatFilters : fmt::format("{},{}", options, kFloatFilters) });
}

/// What the width needs; see the header.
void chooseWidth(Lookup const& lookup, MesaEnvironment& environment) {
    const char* const value = lookup(kWidth);
    const std::string_view width = value ? value : "";
    if (width == "128") {
        environment.changes.push_back(ownCache(lookup));
        return;
    }
    leaveOwnCache(lookup, environment.changes);
    if (width == kDefaultWidth) return;
    environment.changes.push_back({ kWidth, kDefaultWidth });
    if (!width.empty())
        environment.note = fmt::format("{}={}: Mesa's software rasteriser works with 128 or 256 bits; {} are used",
                                       kWidth, width, kDefaultWidth);
}

} // namespace

MesaEnvironment mesaEnvironment(Lookup const& lookup) {
    MesaEnvironment environment;
    chooseWidth(lookup, environment);
    filterInFloatingPoint(lookup, environment.changes);
    return environment;
}

void applyMesaEnvironment() {
    static std::once_flag once;
    std::call_once(once, [] {
        const MesaEnvironment environment = mesaEnvironment([](const char* name) { return std::getenv(name); });
        for (EnvironmentChange const& change : environment.changes) {
            std::error_code ignored; // without a directory Mesa compiles every time
            if (change.name == kCacheDirectory) std::filesystem::create_directories(change.value, ignored);
            setenv(change.name.c_str(), change.value.c_str(), 1);
        }
        if (!environment.note.empty()) log(Severity::Info, "{}", environment.note);
    });
}

} // namespace filament_core::backend
