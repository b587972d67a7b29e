// SPDX-License-Identifier: Apache-2.0
// Light profiles: photometric files -> the words that shaders read.
#include <filament_core/LightProfile.h>

#include "base/OutOfMemory.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/tables/LightProfileTable.h"
#include "filament_core/engine/EngineImpl.h"
#include "shaders/interface/ShaderInterface.h"

#include <bit>

namespace filament_core {

using engine::PublicCall;

namespace {

std::vector<uint32_t> shaderWords(assets::LightProfileTable const& table) {
    std::vector<uint32_t> words;
    words.reserve(shader::kProfileHeaderWords + table.words.size());
    const double rowsPerRadian = (table.rows - 1) / static_cast<double>(table.lastRadians);
    words = { table.rows, table.columns, std::bit_cast<uint32_t>(static_cast<float>(rowsPerRadian)) };
    words.insert(words.end(), table.words.begin(), table.words.end());
    return words;
}

} // namespace

LightProfile Engine::Impl::createLightProfile(assets::IesFile const& file, std::string name) {
    engine::Draft draft(lightProfiles);
    const assets::LightProfileTable table = assets::makeLightProfileTable(file);
    draft.state() = { std::make_shared<const std::vector<uint32_t>>(shaderWords(table)),
                      { Candela{ table.peak }, Lumen{ static_cast<float>(table.lumens) } },
                      std::move(name) };
    return draft.keep();
}

Result<LightProfile> Engine::create(LightProfileDesc const& desc) {
    const PublicCall call(mImpl, "Engine::create(LightProfileDesc)", desc.name);
    return orOutOfMemory("light profile", desc.name, [&]() -> Result<LightProfile> {
        const std::string_view name = desc.name.empty() ? "light profile" : std::string_view(desc.name);
        const Result<assets::IesFile> file = assets::readIes(desc.file, name);
        if (!file) return file.error();
        return mImpl->createLightProfile(*file, desc.name);
    });
}

LightProfileDescription Engine::describe(LightProfile profile) const {
    const PublicCall call(mImpl, "Engine::describe(LightProfile)");
    return mImpl->lightProfiles.get(profile).description;
}

Result<LightProfile> loadLightProfile(Engine& engine, std::filesystem::path const& path) {
    const PublicCall call(engine, "loadLightProfile(Engine, path)", path.native());
    return orOutOfMemory("light profile", path.native(), [&]() -> Result<LightProfile> {
        const Result<std::vector<std::byte>> bytes = assets::readFileBytes(path);
        if (!bytes) return bytes.error();
        return engine.create(LightProfileDesc{ *bytes, path.filename().string() });
    });
}

} // namespace filament_core
