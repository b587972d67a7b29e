// SPDX-License-Identifier: Apache-2.0
#include "toolkit/materials/PlainMaterials.h"

#include "base/Assert.h"
#include "base/Log.h"
#include "shaders/package/EngineMaterials.h"
#include "toolkit/packages/PackageCache.h"

#include <fmt/core.h>

#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace filament_core::tools {
namespace {

std::span<const std::byte> compilePlain(std::string_view name) {
    const std::string_view text = engineMaterialText(name);
    if (text.empty()) return {};
    auto package = compilePackage(text, fmt::format("{}.mat", name), { .exact = false });
    if (!package) log(Severity::Error, "{}", package.error().message);
    FILAMENT_ASSERT(package.ok(), "the engine's own materials compile, as the build showed");
    return shader::keepEnginePackage(std::move(package->bytes));
}

} // namespace

std::span<const std::byte> plainMaterial(std::string_view name) {
    static std::mutex mutex;
    static std::map<std::string, std::span<const std::byte>, std::less<>> compiled;
    const std::scoped_lock lock(mutex);
    const auto known = compiled.find(name);
    if (known != compiled.end()) return known->second;
    return compiled[std::string(name)] = compilePlain(name);
}

} // namespace filament_core::tools
