// SPDX-License-Identifier: Apache-2.0
#include <filament_core/SceneFile.h>

#include "base/AsciiText.h"
#include "base/OutOfMemory.h"
#include "base/Suggest.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/scenefile/JsonText.h"
#include "filament_core/scenefile/ReadContents.h"
#include "filament_core/scenefile/SceneKeys.h"
#include "filament_core/scenefile/WriteValues.h"

#include <nlohmann/json.hpp>

namespace filament_core {

using scenefile::Json;
using scenefile::JsonReader;
using scenefile::Key;

struct SceneFile::Tree {
    std::string name, where;
    std::filesystem::path folder;
    Json json;
    SceneFileContents contents;

    /// Reads the contents; features, too, so that none of them is wrong later.
    static Result<std::shared_ptr<const Tree>> make(Tree tree);
    /// Replaces a tree by a copy whose JSON `edit` changed; it returns a Result<void>. After an error all is as before.
    template <class Edit>
    static Result<void> change(std::shared_ptr<const Tree>& tree, Edit const& edit);
    Result<Tree> withFeature(std::string const& feature) const;
    Result<Key> key(std::string_view text) const;
};

namespace {

constexpr size_t kMostBytes = size_t{ 64 } << 20;

Json const& schemaTree() {
    static const Json schema = scenefile::sceneSchema();
    return schema;
}

SceneFileContents const& emptyContents() {
    static const SceneFileContents contents = *scenefile::readContents(Json::object(), "scene");
    return contents;
}

} // namespace

Result<SceneFile::Tree> SceneFile::Tree::withFeature(std::string const& feature) const {
    Tree tree{ name + "/" + feature, where, folder, json, {} };
    if (where.ends_with(" (" + name + ")")) tree.where.insert(where.size() - 1, "/" + feature);
    const Json patch = json["features"][feature];
    tree.json.erase("features");
    tree.json.erase("kills"); // not inherited: a feature lists its own
    tree.json.merge_patch(patch);
    Result<SceneFileContents> changed = scenefile::readContents(tree.json, tree.where);
    if (!changed) return changed.error();
    tree.contents = std::move(*changed);
    return tree;
}

Result<std::shared_ptr<const SceneFile::Tree>> SceneFile::Tree::make(Tree tree) {
    Result<SceneFileContents> read = scenefile::readContents(tree.json, tree.where);
    if (!read) return read.error();
    tree.contents = std::move(*read);
    if (tree.json.contains("features")) {
        for (auto const& feature : tree.json["features"].items())
            if (const Result<Tree> one = tree.withFeature(feature.key()); !one) return one.error();
    }
    return std::make_shared<const Tree>(std::move(tree));
}

template <class Edit>
Result<void> SceneFile::Tree::change(std::shared_ptr<const Tree>& tree, Edit const& edit) {
    return orOutOfMemory("scene file", tree->name, [&]() -> Result<void> {
        Tree next{ tree->name, tree->where, tree->folder, tree->json, {} };
        const Result<void> done = edit(next.json);
        if (!done) return fail(done.error().code, "{}: {}", tree->where, done.error().message);
        auto made = make(std::move(next));
        if (!made) return made.error();
        tree = std::move(*made);
        return {};
    });
}

Result<Key> SceneFile::Tree::key(std::string_view text) const { return scenefile::parseKey(text, json, schemaTree()); }

SceneFile::SceneFile()
        : mTree(std::make_shared<const Tree>(
                  Tree{ "scene", "scene", {}, { { "version", kVersion } }, emptyContents() })) {}

Result<SceneFile> SceneFile::load(std::filesystem::path const& file) {
    return orOutOfMemory("scene file", file.native(), [&]() -> Result<SceneFile> {
        const Result<std::string> text = assets::readText(file, kMostBytes);
        if (!text) return text.error();
        Result<Json> json = scenefile::parseJson(*text, file.string());
        if (!json) return json.error();
        const std::string name = file.stem().string();
        const std::string where = fmt::format("{} ({})", file.filename().string(), name);
        auto tree = Tree::make({ name, where, file.parent_path(), std::move(*json), {} });
        return tree ? Result<SceneFile>(SceneFile(std::move(*tree))) : tree.error();
    });
}

Result<SceneFile> SceneFile::parse(std::string_view text, std::string_view name, std::filesystem::path const& folder) {
    return orOutOfMemory("scene file", name, [&]() -> Result<SceneFile> {
        if (text.size() > kMostBytes)
            return fail(ErrorCode::Unreadable, "{}: {} bytes are more than the {} of a scene file", name, text.size(),
                        kMostBytes);
        Result<Json> json = scenefile::parseJson(text, name);
        if (!json) return json.error();
        auto tree = Tree::make({ std::string(name), std::string(name), folder, std::move(*json), {} });
        return tree ? Result<SceneFile>(SceneFile(std::move(*tree))) : tree.error();
    });
}

Result<void> SceneFile::save(std::filesystem::path const& file) const {
    return orOutOfMemory("scene file", file.native(), [&] {
        const std::string written = text();
        return assets::replaceFile(file, std::as_bytes(std::span(written)));
    });
}

std::string SceneFile::text() const { return scenefile::jsonText(mTree->json, 2); }
std::string const& SceneFile::name() const { return mTree->name; }
std::filesystem::path const& SceneFile::folder() const { return mTree->folder; }
SceneFileContents const& SceneFile::contents() const { return mTree->contents; }

std::optional<std::string> SceneFile::get(std::string_view key) const {
    const Result<Key> parsed = mTree->key(key);
    Json const* found = parsed ? scenefile::find(mTree->json, *parsed) : nullptr;
    if (!found) return std::nullopt;
    return found->dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<void> SceneFile::set(std::string_view key, std::string_view value) {
    return Tree::change(mTree, [&](Json& json) -> Result<void> {
        const Result<Key> parsed = mTree->key(key);
        if (!parsed) return parsed.error();
        return scenefile::put(json, *parsed, scenefile::valueOf(value, parsed->schema));
    });
}

Result<void> SceneFile::erase(std::string_view key) {
    return Tree::change(mTree, [&](Json& json) -> Result<void> {
        const Result<Key> parsed = mTree->key(key);
        if (!parsed) return parsed.error();
        if (scenefile::take(json, *parsed)) return {};
        return fail(ErrorCode::NotFound, "the file has no '{}'", printable(key));
    });
}

Result<void> SceneFile::add(LightDesc const& light) {
    return Tree::change(mTree, [&](Json& json) -> Result<void> {
        json[scenefile::listOf(light)].push_back(scenefile::toJson(light));
        return {};
    });
}

Result<void> SceneFile::setCamera(Camera const& camera) {
    return Tree::change(mTree, [&](Json& json) -> Result<void> {
        scenefile::writeCamera(json, camera, mTree->contents.origin);
        return {};
    });
}

Result<void> SceneFile::setView(View const& view) {
    return Tree::change(mTree, [&](Json& json) -> Result<void> {
        scenefile::writeView(json, view, emptyContents().view);
        return {};
    });
}

std::vector<std::string> SceneFile::featureNames() const {
    std::vector<std::string> names;
    if (!mTree->json.contains("features")) return names;
    for (auto const& feature : mTree->json["features"].items()) names.push_back(feature.key());
    return names;
}

Result<SceneFile> SceneFile::feature(std::string_view name) const {
    const std::vector<std::string> names = featureNames();
    if (std::ranges::find(names, name) == names.end()) {
        const std::vector<std::string_view> known(names.begin(), names.end());
        return fail(ErrorCode::NotFound, "{}: there is no feature '{}'{}", mTree->where, printable(name),
                    known.empty() ? "; it has none" : "; it has " + listed(known));
    }
    Result<Tree> tree = mTree->withFeature(std::string(name));
    if (!tree) return tree.error();
    return SceneFile(std::make_shared<const Tree>(std::move(*tree)));
}

std::string SceneFile::schema() { return scenefile::jsonText(schemaTree(), 1); }

bool operator==(SceneFile const& a, SceneFile const& b) {
    // members of a plain json are sorted, so their order does not count
    return nlohmann::json(a.mTree->json) == nlohmann::json(b.mTree->json);
}

} // namespace filament_core
