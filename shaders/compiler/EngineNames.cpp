// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/EngineNames.h"

#include "shaders/compiler/EmbeddedSources.h"
#include "shaders/compiler/GlslTokens.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace filament_core::shader {
namespace {

constexpr std::string_view kColors = "shaders/lib/color.glsl";

constexpr std::array<std::string_view, 18> kHelpers{ "HALF_PI",
                                                     "PI",
                                                     "cofactor",
                                                     "heatmap",
                                                     "inverseTonemap",
                                                     "inverseTonemapSRGB",
                                                     "isPerspectiveProjection",
                                                     "luminance",
                                                     "max3",
                                                     "min3",
                                                     "mulMat3x3Float3",
                                                     "mulMat4x4Float3",
                                                     "pow5",
                                                     "saturate",
                                                     "sq",
                                                     "vmax",
                                                     "vmin",
                                                     "ycbcrToRgb" };

/// What the engine calls or passes by these names.
constexpr std::string_view kTaken[] = { "main",           "MaterialInputs", "MaterialVertexInputs", "PostProcessInputs",
                                        "ShadingData",    "LightData",      "materialParams",       "prepareMaterial",
                                        "getCurrentPixel" };

/// Declared by the compiler rather than by a file.
constexpr std::string_view kGenerated[] = { "initMaterial", "MaterialParams", "VARYING", "INTERPOLATION" };

/// Parts of materials: what they declare is the author's.
bool belongsToMaterials(std::string_view path) {
    return path.starts_with("shaders/material/gltf/") || path == "shaders/post/dither.glsl" ||
           path == "shaders/post/tone_table.glsl";
}

std::string_view wordAt(std::string_view text, size_t at) {
    size_t end = at;
    while (end < text.size() && isGlslWordPart(text[end])) ++end;
    return text.substr(at, end - at);
}

/// The words of #if and the like: macros that the compiler defines.
void addConditions(std::string_view text, NameSet& out) {
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find('\n', at), text.size());
        std::string_view line = text.substr(at, end - at);
        line = line.substr(0, line.find("//"));
        at = end + 1;
        if (!line.starts_with("#if") && !line.starts_with("#elif")) continue;
        for (size_t i = 1; i < line.size(); ++i) {
            const std::string_view word = wordAt(line, i);
            if (word.empty()) continue;
            i += word.size();
            const bool isSyntax = word.starts_with("if") || word == "elif" || word == "defined";
            if (!isSyntax && std::isdigit(static_cast<unsigned char>(word[0])) == 0) out.emplace(word);
        }
    }
}

struct EngineTables {
    NameSet names;
    std::vector<GlslDeclaration> helpers; ///< functions and constants
};

EngineTables makeTables() {
    EngineTables tables;
    tables.names.insert(std::begin(kGenerated), std::end(kGenerated));
    for (const std::string_view path : embeddedPaths()) {
        if (belongsToMaterials(path)) continue;
        const std::string_view text = *embeddedSource(path);
        addConditions(text, tables.names);
        for (GlslDeclaration& declaration : outlineOf(text, path)) {
            const bool isHelper = declaration.kind != GlslDeclaration::Kind::Macro &&
                                  std::ranges::binary_search(kHelpers, declaration.name);
            tables.names.insert(declaration.name);
            if (isHelper) tables.helpers.push_back(std::move(declaration));
        }
    }
    for (const std::string_view taken : kTaken) tables.names.erase(std::string(taken));
    return tables;
}

EngineTables const& engineTables() {
    static const EngineTables tables = makeTables();
    return tables;
}

/// The same name, and for functions the same parameters.
bool declaresSame(std::span<const GlslDeclaration> authors, GlslDeclaration const& helper) {
    return std::ranges::any_of(authors, [&](GlslDeclaration const& own) {
        if (own.name != helper.name || own.kind == GlslDeclaration::Kind::Macro) return false;
        const bool areFunctions =
                own.kind == GlslDeclaration::Kind::Function && helper.kind == GlslDeclaration::Kind::Function;
        return !areFunctions || own.parameters == helper.parameters;
    });
}

std::string restored(GlslDeclaration const& helper) {
    if (helper.kind != GlslDeclaration::Kind::Function)
        return fmt::format("const float {} = {}{};\n", helper.name, kReservedPrefix, helper.name);
    std::string parameters, arguments;
    for (size_t i = 0; i < helper.parameters.size(); ++i) {
        const char* const comma = i > 0 ? ", " : "";
        parameters += fmt::format("{}{} a{}", comma, helper.parameters[i], i);
        arguments += fmt::format("{}a{}", comma, i);
    }
    return fmt::format("{} {}({}) {{ return {}{}({}); }}\n", helper.type, helper.name, parameters, kReservedPrefix,
                       helper.name, arguments);
}

/// Copies a text word by word. Inside of structures and blocks, a word in front of ';', ',' or '[' is a member's name.
class Prefixer {
public:
    Prefixer(std::string_view text, NameSet const& names) : mText(text), mNames(names) {}

    std::string run() {
        while (mAt < mText.size()) {
            if (const size_t comment = commentLength(); comment > 0)
                copy(comment);
            else if (isGlslWordPart(mText[mAt]))
                word();
            else
                mark();
        }
        return std::move(mOut);
    }

private:
    size_t commentLength() const {
        const std::string_view rest = mText.substr(mAt);
        if (rest.starts_with("//") || rest.starts_with("#include")) return std::min(rest.find('\n'), rest.size());
        return rest.starts_with("/*") ? std::min(rest.find("*/", 2), rest.size() - 2) + 2 : 0;
    }

    void copy(size_t count) {
        mOut += mText.substr(mAt, count);
        mAt += count;
    }

    void mark() {
        const char c = mText[mAt];
        if (c == '{') mIsInMembers = mIsInMembers || (mDepth == 0 && mSawType), ++mDepth;
        if (c == '}' && --mDepth == 0) mIsInMembers = mSawType = false;
        if (c == ';' && mDepth == 0) mSawType = false;
        if (std::isspace(static_cast<unsigned char>(c)) == 0) mPrevious = c;
        copy(1);
    }

    void word() {
        const std::string_view name = wordAt(mText, mAt);
        if (mDepth == 0 && (name == "struct" || name == "uniform" || name == "buffer")) mSawType = true;
        const size_t next = std::min(mText.find_first_not_of(" \t\n", mAt + name.size()), mText.size() - 1);
        const bool isMember = mIsInMembers && (mText[next] == ';' || mText[next] == ',' || mText[next] == '[');
        if (mPrevious != '.' && !isMember && mNames.contains(name)) mOut += kReservedPrefix;
        mPrevious = 'w';
        copy(name.size());
    }

    std::string_view mText;
    NameSet const& mNames;
    std::string mOut;
    size_t mAt = 0;
    int mDepth = 0;
    bool mSawType = false, mIsInMembers = false;
    char mPrevious = ' ';
};

} // namespace

bool isEngineFile(std::string_view file) {
    return file == "generated" || (embeddedSource(file) && !belongsToMaterials(file));
}

std::vector<GlslDeclaration> authorsDeclarations(std::string_view glsl, std::string_view file) {
    std::vector<GlslDeclaration> declarations = outlineOf(glsl, file);
    std::erase_if(declarations, [](GlslDeclaration const& each) { return embeddedSource(each.file).has_value(); });
    return declarations;
}

Result<void> checkNames(std::span<const GlslDeclaration> declarations) {
    for (GlslDeclaration const& own : declarations) {
        const bool isReserved = own.name.starts_with(kReservedPrefix);
        if (!isReserved && std::ranges::count(kTaken, own.name) == 0) continue;
        const std::string why = isReserved ? fmt::format("names that begin with {} are the engine's", kReservedPrefix)
                                           : fmt::format("the engine itself defines '{}'", own.name);
        return fail(ErrorCode::InvalidArgument, "{}:{}: {}; choose another name", own.file, own.line, why);
    }
    return {};
}

void addCollisions(std::span<const GlslDeclaration> declarations, NameSet& out) {
    for (GlslDeclaration const& own : declarations) {
        if (engineTables().names.contains(own.name)) out.insert(own.name);
    }
}

std::string withPrefixes(std::string_view engineText, NameSet const& names) {
    return names.empty() ? std::string(engineText) : Prefixer(engineText, names).run();
}

std::string restoredHelpers(NameSet const& names, std::span<const GlslDeclaration> authors, bool hasColors) {
    std::string text;
    for (GlslDeclaration const& helper : engineTables().helpers) {
        const bool isIncluded = hasColors || helper.file != kColors;
        if (isIncluded && names.contains(helper.name) && !declaresSame(authors, helper)) text += restored(helper);
    }
    return text;
}

std::span<const std::string_view> helperNames() { return kHelpers; }

} // namespace filament_core::shader
