// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/MaterialModel.h"

#include <nlohmann/json.hpp>

namespace filament::conformance {
namespace {

using Words = std::vector<std::pair<std::string, std::string>>;

void readWords(JsonReader& reader, const char* key, Words& words) {
    Json const* object = reader.raw(key);
    if (!object) return;
    if (!object->is_object()) return reader.complain(key, "expected an object of strings");
    for (auto const& [name, value] : object->items()) {
        if (!value.is_string()) return reader.complain(key, fmt::format("'{}': expected a string", name));
        words.emplace_back(name, value.get<std::string>());
    }
}

} // namespace

bool isMaterialModel(SceneSpec const& spec) { return spec.modelObject && spec.modelObject->contains("material"); }

Result<MaterialModelFile> readMaterialModel(SceneSpec const& spec) {
    std::string path;
    MaterialModelFile model;
    Words edits;
    JsonReader reader(*spec.modelObject, spec.name + ": model");
    reader.read("material", path);
    reader.read("mesh", model.mesh);
    readWords(reader, "edits", edits);
    readWords(reader, "values", model.values);
    if (const Result<void> done = reader.finish(); !done) return done.error();
    Result<std::shared_ptr<const tools::MaterialFile>> file = tools::readMaterialFile(spec.folder / path, edits);
    if (!file) return file.error();
    model.file = std::move(*file);
    return model;
}

Result<tools::MaterialStand> makeMaterialModel(Engine& engine, SceneSpec const& spec) {
    const Result<MaterialModelFile> model = readMaterialModel(spec);
    if (!model) return model.error();
    return tools::MaterialStand::make(engine, *model->file, model->values, model->mesh);
}

} // namespace filament::conformance
