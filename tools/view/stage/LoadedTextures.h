// SPDX-License-Identifier: Apache-2.0
/// LoadedTextures: the images of a document's texture edits on one engine.
///   Loads    in the background, each file once; what was there stays until another one has come.
///   Life     a texture that is no longer wanted lives until dropRetired(): materials may still show it.
///   Thread   the app thread of the engine.
///   Fails    poll(): a message, once a load; its edit then shows what it showed before.
#pragma once

#include "tools/view/document/Document.h"
#include "tools/view/stage/Background.h"
#include "tools/view/stage/Messages.h"

#include <filament_core/Engine.h>
#include <filament_core/Image.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::view {

class LoadedTextures {
public:
    /// Begins to load what is not there, or all of them again.
    void want(std::vector<TextureEdit> const& edits, bool again, Abandoned& abandoned);
    /// Loads one file again, if it is one of them.
    void reload(std::filesystem::path const& file, Abandoned& abandoned);
    /// True: materials are to show other textures; after that, dropRetired().
    bool poll(Engine& engine, Messages& messages);
    void drop(Abandoned& abandoned); ///< unfinished loads
    void dropRetired() { mRetired.clear(); }

    /// None: not there yet, or its file cannot be read.
    Texture find(TextureEdit const& edit) const;
    bool isLoading() const;
    std::optional<std::filesystem::path> firstLoading() const;

private:
    using Key = std::pair<std::filesystem::path, bool>; ///< whether its numbers are data
    struct Entry {
        std::optional<Background<Result<Image>>> load{};
        Owned<Texture> texture{};
    };
    static Key keyOf(TextureEdit const& edit) { return { edit.file, edit.isData }; }
    void start(Key const& key, Abandoned& abandoned);

    std::map<Key, Entry> mEntries;
    std::vector<Owned<Texture>> mRetired;
};

} // namespace filament_core::view
