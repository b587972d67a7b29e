// SPDX-License-Identifier: Apache-2.0
#include "tools/materials/MaterialFile.h"

#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/files/PathInside.h"
#include "shaders/compiler/MaterialCompiler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>

namespace filament::tools {
namespace {

namespace fs = std::filesystem;

Result<std::string> readText(fs::path const& path) {
    Result<std::vector<std::byte>> bytes = assets::readFileBytes(path);
    if (!bytes) return bytes.error();
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
}

Result<std::string> edited(std::string text, std::vector<TextEdit> const& edits, std::string const& name) {
    for (auto const& [from, to] : edits) {
        const size_t at = text.find(from);
        if (from.empty() || at == std::string::npos)
            return fail(ErrorCode::NotFound, "{}: there is no '{}' to replace", name, from);
        text.replace(at, from.size(), to);
    }
    return text;
}

Result<std::vector<std::byte>> compiled(std::string const& text, fs::path const& path, uint16_t filteredVariants) {
    const auto beside = [&](std::string_view name) -> std::optional<std::string> {
        const Result<fs::path> inside = assets::fileInside(path.parent_path(), name);
        if (!inside) return std::nullopt;
        const Result<std::string> file = readText(*inside);
        return file ? std::optional(*file) : std::nullopt;
    };
    const Result<shader::MaterialPackage> package = shader::compileMaterial(
            text, path.filename().string(), { .filteredVariants = filteredVariants, .includes = beside });
    if (!package) return package.error();
    return shader::writePackage(*package);
}

std::string keyOf(fs::path const& path, std::vector<TextEdit> const& edits, uint16_t filteredVariants) {
    std::string key = fmt::format("{}\n{}", path.string(), filteredVariants);
    for (auto const& [from, to] : edits) key += "\n" + from + "\n" + to;
    return key;
}

} // namespace

Result<MaterialFile> compileMaterialFile(fs::path const& path, std::vector<TextEdit> const& edits,
                                         uint16_t filteredVariants) {
    MaterialFile file{ .name = path.stem().string(), .bytes = {}, .package = {}, .show = {} };
    Result<std::string> text = readText(path);
    if (!text) return text.error();
    if (path.extension() == ".mat") {
        text = edited(std::move(*text), edits, file.name);
        if (!text) return text.error();
        Result<MaterialShow> show = readMaterialShow(*text, path.filename().string());
        if (!show) return show.error();
        file.show = std::move(*show);
        Result<std::vector<std::byte>> bytes = compiled(*text, path, filteredVariants);
        if (!bytes) return bytes.error();
        file.bytes = std::move(*bytes);
    } else {
        const auto bytes = std::as_bytes(std::span(*text));
        file.bytes.assign(bytes.begin(), bytes.end());
    }
    Result<shader::MaterialPackage> package = shader::readPackage(file.bytes);
    if (!package) return fail(package.error().code, "{}: {}", path.string(), package.error().message);
    file.package = std::move(*package);
    return file;
}

bool isMaterialFile(fs::path const& path) { return path.extension() == ".mat" || path.extension() == ".fmat"; }

Result<MaterialShow> readMaterialShow(std::string_view text, std::string_view fileName) {
    constexpr std::string_view kMark = "// show:";
    MaterialShow show;
    const size_t mark = text.find(kMark);
    if (mark == std::string_view::npos) return show;
    const size_t begin = mark + kMark.size();
    std::istringstream words(std::string(text.substr(begin, text.find('\n', begin) - begin)));
    for (std::string word; words >> word;) {
        const size_t equals = word.find('=');
        if (equals == 0 || equals == std::string::npos)
            return fail(ErrorCode::InvalidArgument, "{}: '{}' after '// show:' is not name=value", fileName, word);
        std::string name = word.substr(0, equals), value = word.substr(equals + 1);
        if (name == "mesh")
            show.mesh = value;
        else if (name == "slab")
            show.slab = value == "true";
        else if (name == "instances")
            show.instances = static_cast<uint32_t>(std::clamp(std::atoi(value.c_str()), 1, 16));
        else
            show.values.emplace_back(std::move(name), std::move(value));
    }
    return show;
}

Result<std::shared_ptr<const MaterialFile>> readMaterialFile(fs::path const& path, std::vector<TextEdit> const& edits,
                                                             uint16_t filteredVariants) {
    static std::mutex mutex;
    static std::map<std::string, std::shared_ptr<const MaterialFile>> known;
    const std::lock_guard lock(mutex);
    std::shared_ptr<const MaterialFile>& entry = known[keyOf(path, edits, filteredVariants)];
    if (!entry) {
        Result<MaterialFile> file = compileMaterialFile(path, edits, filteredVariants);
        if (!file) return file.error();
        entry = std::make_shared<const MaterialFile>(std::move(*file));
    }
    return entry;
}

} // namespace filament::tools
