// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Effect.h"

#include "toolkit/json/JsonFile.h"
#include "tools/accuracy/Settings.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>

namespace filament_core::accuracy {
namespace {

using tools::Json;
using tools::JsonReader;

constexpr std::array<std::pair<std::string_view, ReferenceKind>, 7> kKinds{ {
        { "setting", ReferenceKind::Setting },
        { "scene", ReferenceKind::Scene },
        { "supersampled", ReferenceKind::Supersampled },
        { "traced", ReferenceKind::Traced },
        { "otherBackend", ReferenceKind::OtherBackend },
        { "furnace", ReferenceKind::Furnace },
        { "integral", ReferenceKind::Integral },
} };

std::optional<ReferenceKind> kindFromName(std::string_view name) {
    for (auto const& [word, kind] : kKinds)
        if (word == name) return kind;
    return std::nullopt;
}

std::optional<Cost> costFromName(std::string_view name) {
    for (const Cost cost : { Cost::Frame, Cost::Environment, Cost::Model })
        if (name == toString(cost)) return cost;
    return std::nullopt;
}

std::vector<std::string> wordsOf(std::string const& text) {
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

/// Every value must exist in the engine.
void checkWords(JsonReader& reader, const char* key, std::vector<std::string> const& words) {
    Settings scratch;
    if (const Result<void> done = change(scratch, words); !done) reader.complain(key, done.error().message);
}

void readValues(JsonReader& reader, Effect& effect) {
    std::string choice;
    std::vector<std::string> texts;
    reader.read("choice", choice);
    reader.read("values", texts);
    if (texts.empty()) texts = valuesOf(choice);
    if (texts.size() < 2) reader.complain("values", "a choice has two values or more");
    for (std::string const& text : texts) {
        Value value{ .name = text };
        value.set = text.find('=') == std::string::npos ? std::vector{ choice + "=" + text } : wordsOf(text);
        checkWords(reader, "values", value.set);
        effect.values.push_back(std::move(value));
    }
}

void readIndex(JsonReader& reader, const char* key, Effect const& effect, size_t& index) {
    std::string name;
    reader.read(key, name);
    if (name.empty()) return;
    const auto found = std::ranges::find(effect.values, name, &Value::name);
    if (found == effect.values.end()) return reader.complain(key, "'" + name + "' is none of the values");
    index = static_cast<size_t>(found - effect.values.begin());
}

void readReference(JsonReader& reader, Reference& reference) {
    reader.choice("kind", reference.kind, "setting, scene, supersampled, traced, otherBackend, furnace or integral",
                  kindFromName);
    reader.read("set", reference.set);
    checkWords(reader, "set", reference.set);
    reader.read("scene", reference.scene);
    reader.read("integral", reference.integral);
    reader.read("factor", reference.factor, 2, 16);
    reader.read("samples", reference.samples, 1, 1u << 20);
    reader.read("paths", reference.hasPaths);
    if ((reference.kind == ReferenceKind::Scene) == reference.scene.empty())
        reader.complain("scene", "the other scene, for \"kind\": \"scene\" only");
    if ((reference.kind == ReferenceKind::Integral) == reference.integral.empty())
        reader.complain("integral", "the name of the integral, for \"kind\": \"integral\" only");
}

Result<Effect> readEffect(Json const& json, std::string const& where) {
    Effect effect;
    JsonReader reader(json, where);
    reader.read("name", effect.name);
    reader.read("title", effect.title);
    reader.read("question", effect.question);
    reader.read("scene", effect.scene);
    reader.read("frame", effect.frame);
    reader.read("base", effect.base);
    checkWords(reader, "base", effect.base);
    readValues(reader, effect);
    readIndex(reader, "standard", effect, effect.standard);
    readIndex(reader, "best", effect, effect.best);
    reader.object("reference", [&](JsonReader& r) { readReference(r, effect.reference); });
    reader.choice("cost", effect.cost, "frame, environment or model", costFromName);
    for (auto const& [key, text] : { std::pair("name", &effect.name), std::pair("title", &effect.title),
                                     std::pair("question", &effect.question) }) {
        if (text->empty()) reader.complain(key, "an effect needs one");
    }
    if (effect.scene.empty() && effect.reference.kind != ReferenceKind::Integral)
        reader.complain("scene", "an effect needs one, unless its reference is an integral");
    if (const Result<void> done = reader.finish(); !done) return done.error();
    return effect;
}

std::string withSettings(std::string text, std::vector<std::string> const& set) {
    if (!set.empty()) text += fmt::format(", {}", fmt::join(set, " "));
    return text;
}

} // namespace

const char* toString(Cost cost) {
    switch (cost) {
    case Cost::Frame:
        return "frame";
    case Cost::Environment:
        return "environment";
    case Cost::Model:
        return "model";
    }
    return "";
}

std::string describe(Reference const& reference) {
    switch (reference.kind) {
    case ReferenceKind::Setting:
        return withSettings("the engine at its finest", reference.set);
    case ReferenceKind::Scene:
        return fmt::format("the engine in the scene {}, where the difficulty is absent", reference.scene);
    case ReferenceKind::Supersampled:
        return withSettings(
                fmt::format("the engine with {0} x {0} samples a pixel, averaged in linear light", reference.factor),
                reference.set);
    case ReferenceKind::Traced:
        return withSettings(fmt::format("the path tracer in double precision, {}, {} samples a pixel",
                                        reference.hasPaths ? "all light with every bounce"
                                                           : "one reflection of light that nothing blocks",
                                        reference.samples),
                            reference.set);
    case ReferenceKind::OtherBackend:
        return "the same value on the other backend: how far the two pictures part";
    case ReferenceKind::Furnace:
        return "closed form: in a white furnace a surface that reflects everything looks like the furnace";
    case ReferenceKind::Integral:
        return fmt::format("quadrature in double precision: {}", reference.integral);
    }
    return {};
}

Result<std::vector<Effect>> readEffects(std::filesystem::path const& file) {
    const Result<Json> json = tools::readJson(file);
    if (!json) return json.error();
    if (!json->is_array()) return fail(ErrorCode::Corrupt, "{}: not a JSON list of effects", file.string());
    std::vector<Effect> effects;
    for (size_t i = 0; i < json->size(); ++i) {
        Result<Effect> effect = readEffect((*json)[i], fmt::format("{}: effect {}", file.filename().string(), i + 1));
        if (!effect) return effect.error();
        if (std::ranges::find(effects, effect->name, &Effect::name) != effects.end())
            return fail(ErrorCode::InvalidArgument, "{}: two effects are called '{}'", file.string(), effect->name);
        effects.push_back(std::move(*effect));
    }
    return effects;
}

} // namespace filament_core::accuracy
