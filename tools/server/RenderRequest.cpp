// SPDX-License-Identifier: Apache-2.0
#include "tools/server/RenderRequest.h"

#include "base/Suggest.h"
#include "toolkit/json/JsonFile.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>

namespace filament_core::server {
namespace {

namespace fs = std::filesystem;
using tools::Json;

constexpr std::array<std::string_view, 7> kMembers{ "id", "scene", "sceneFile", "set", "size", "api", "format" };

Error wrong(std::string_view member, std::string_view what) {
    return { ErrorCode::InvalidArgument, fmt::format("request: {}: {}", member, what) };
}

/// A path below a folder, by a name that does not leave it: neither by "..", nor by links.
Result<fs::path> below(fs::path const& folder, std::string_view name, std::string_view member) {
    const fs::path path(name);
    if (folder.empty()) return wrong(member, "this server has no folder for it");
    if (name.empty() || path.is_absolute()) return wrong(member, fmt::format("'{}' is no relative name", name));
    std::error_code error;
    const fs::path root = fs::weakly_canonical(folder, error), file = fs::weakly_canonical(root / path, error);
    const fs::path relative = file.lexically_relative(root);
    if (error || relative.empty() || *relative.begin() == "..")
        return wrong(member, fmt::format("'{}' is outside of the server's folder", name));
    return file;
}

Result<SceneFile> sceneOf(Json const& json, RequestLimits const& limits) {
    const bool isGiven = json.contains("scene"), isNamed = json.contains("sceneFile");
    if (isGiven == isNamed) return wrong("scene", "give one of scene and sceneFile");
    if (isGiven) {
        if (!json["scene"].is_object()) return wrong("scene", "an object, as of a scene file");
        return SceneFile::parse(json["scene"].dump(), "scene");
    }
    if (!json["sceneFile"].is_string()) return wrong("sceneFile", "a name");
    const Result<fs::path> file = below(limits.scenes, json["sceneFile"].get<std::string>(), "sceneFile");
    if (!file) return file.error();
    Result<SceneFile> scene = SceneFile::load(*file);
    // The path on this machine is nobody else's business.
    if (!scene && scene.error().code == ErrorCode::NotFound) return wrong("sceneFile", "there is no such scene");
    return scene;
}

Result<void> applySettings(Json const& json, SceneFile& scene) {
    if (json.contains("set")) {
        if (!json["set"].is_object()) return wrong("set", "an object of keys and values");
        for (auto const& [key, value] : json["set"].items()) {
            const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
            if (Result<void> done = scene.set(key, text); !done) return done;
        }
    }
    if (json.contains("size")) {
        if (Result<void> done = scene.set("view.size", json["size"].dump()); !done)
            return wrong("size", done.error().message);
    }
    return {};
}

template <class T>
Result<void> choose(Json const& json, const char* member, std::initializer_list<std::pair<const char*, T>> values,
                    T& out) {
    if (!json.contains(member)) return {};
    std::string all;
    for (auto const& [word, value] : values) {
        if (json[member] == word) {
            out = value;
            return {};
        }
        all += fmt::format("{}{}", all.empty() ? "" : " or ", word);
    }
    return wrong(member, fmt::format("{} is not {}", json[member].dump(), all));
}

Result<void> checkLimits(SceneFile const& scene, RequestLimits const& limits) {
    SceneFileContents const& contents = scene.contents();
    const uint64_t pixels = uint64_t{ contents.view.size.x } * contents.view.size.y;
    if (pixels > limits.mostPixels)
        return wrong("size", fmt::format("{} pixels; this server draws up to {}", pixels, limits.mostPixels));
    if (contents.frames > limits.mostFrames)
        return wrong("view.frames", fmt::format("{}; this server draws up to {}", contents.frames, limits.mostFrames));
    return {};
}

} // namespace

Result<RenderRequest> parseRequest(std::string_view text, RequestLimits const& limits) {
    Result<Json> json = tools::parseJson(text, "request");
    if (!json) return json.error();
    if (!json->is_object()) return wrong("JSON", "an object");
    for (auto const& [key, value] : json->items()) {
        if (std::ranges::find(kMembers, key) == kMembers.end())
            return wrong(key, fmt::format("no such member{}", suggestion(key, kMembers)));
    }
    RenderRequest request;
    if (json->contains("id")) {
        if (!(*json)["id"].is_string()) return wrong("id", "a name");
        request.id = (*json)["id"].get<std::string>();
    }
    Result<void> done = choose(*json, "api", { { "gles", Backend::Gles }, { "vulkan", Backend::Vulkan } }, request.api);
    if (done)
        done = choose(*json, "format", { { "png", ImageFormat::Png }, { "exr", ImageFormat::Exr } }, request.format);
    if (!done) return done.error();
    Result<SceneFile> scene = sceneOf(*json, limits);
    if (!scene) return scene.error();
    request.scene = std::move(*scene);
    done = applySettings(*json, request.scene);
    if (done) done = checkLimits(request.scene, limits);
    if (!done) return done.error();
    return request;
}

SceneBuildOptions buildOptions(RequestLimits const& limits, SceneFile const& scene) {
    const fs::path folder = scene.folder();
    return { .assets = limits.assets,
             .find = [limits, folder](SceneFileName const& name) -> Result<std::optional<fs::path>> {
                 if (name.kind == SceneFileKind::Object) return std::optional<fs::path>{};
                 constexpr std::string_view kAsset = "asset:";
                 const bool isAsset = name.name.starts_with(kAsset);
                 const std::string rest = isAsset ? name.name.substr(kAsset.size()) : name.name;
                 // A scene that came over the network has no folder of its own.
                 const fs::path root = isAsset ? limits.assets : folder.empty() ? fs::path{} : limits.scenes;
                 std::string from = rest;
                 if (!isAsset && !folder.empty())
                     from = (folder / rest).lexically_relative(fs::weakly_canonical(limits.scenes)).string();
                 Result<fs::path> file = below(root, from, name.name);
                 if (!file) return file.error();
                 return std::optional(*file);
             } };
}

std::string withoutFolders(std::string message, RequestLimits const& limits) {
    for (auto const& [folder, word] : { std::pair(limits.assets, "assets"), std::pair(limits.scenes, "scenes") }) {
        if (folder.empty()) continue;
        std::error_code error;
        for (std::string const& path : { fs::weakly_canonical(folder, error).string(), folder.string() }) {
            for (size_t at = message.find(path); !path.empty() && at != std::string::npos; at = message.find(path, at))
                message.replace(at, path.size(), word), at += std::string_view(word).size();
        }
    }
    return message;
}

const char* contentType(ImageFormat format) { return format == ImageFormat::Png ? "image/png" : "image/x-exr"; }

} // namespace filament_core::server
