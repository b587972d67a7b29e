// SPDX-License-Identifier: Apache-2.0
#include "tools/view/stage/LoadedTextures.h"

#include "base/Result.h"

#include <algorithm>

namespace filament_core::view {
namespace {

Result<Owned<Texture>> textureOn(Engine& engine, Image const& image, std::filesystem::path const& file) {
    const uint32_t largest = engine.device().maxTextureSize;
    if (std::max(image.width, image.height) > largest)
        return fail(ErrorCode::Unsupported, "'{}' has {} x {} pixels, and the device takes {} a side; make it smaller",
                    file.string(), image.width, image.height, largest);
    return engine.own(engine.create(textureOf(image, file.filename().string())));
}

} // namespace

void LoadedTextures::start(Key const& key, Abandoned& abandoned) {
    Entry& entry = mEntries[key];
    abandoned.add(entry.load);
    const ImageContent content = key.second ? ImageContent::Data : ImageContent::Color;
    entry.load.emplace([file = key.first, content] { return loadImage(file, { .content = content }); });
}

void LoadedTextures::want(std::vector<TextureEdit> const& edits, bool again, Abandoned& abandoned) {
    for (auto entry = mEntries.begin(); entry != mEntries.end();) {
        const bool isWanted =
                std::ranges::any_of(edits, [&](TextureEdit const& edit) { return keyOf(edit) == entry->first; });
        if (isWanted) {
            ++entry;
            continue;
        }
        abandoned.add(entry->second.load);
        if (entry->second.texture.get()) mRetired.push_back(std::move(entry->second.texture));
        entry = mEntries.erase(entry);
    }
    for (TextureEdit const& edit : edits)
        if (!edit.file.empty() && (again || !mEntries.contains(keyOf(edit)))) start(keyOf(edit), abandoned);
}

void LoadedTextures::reload(std::filesystem::path const& file, Abandoned& abandoned) {
    for (auto const& [key, entry] : mEntries)
        if (key.first == file) start(key, abandoned);
}

bool LoadedTextures::poll(Engine& engine, Messages& messages) {
    bool isNew = false;
    for (auto& [key, entry] : mEntries) {
        const std::optional<Result<Image>> image = takeFinished(entry.load);
        if (!image) continue;
        Result<Owned<Texture>> texture = *image ? textureOn(engine, **image, key.first) : image->error();
        if (!texture) {
            messages.add(texture.error().message);
            continue;
        }
        if (entry.texture.get()) mRetired.push_back(std::move(entry.texture));
        entry.texture = std::move(*texture);
        isNew = true;
    }
    return isNew;
}

void LoadedTextures::drop(Abandoned& abandoned) {
    for (auto& [key, entry] : mEntries) abandoned.add(entry.load);
}

Texture LoadedTextures::find(TextureEdit const& edit) const {
    const auto found = mEntries.find(keyOf(edit));
    return found == mEntries.end() ? Texture{} : found->second.texture.get();
}

bool LoadedTextures::isLoading() const { return firstLoading().has_value(); }

std::optional<std::filesystem::path> LoadedTextures::firstLoading() const {
    for (auto const& [key, entry] : mEntries)
        if (entry.load) return key.first;
    return std::nullopt;
}

} // namespace filament_core::view
