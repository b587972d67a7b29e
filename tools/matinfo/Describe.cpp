// SPDX-License-Identifier: Apache-2.0
#include "tools/matinfo/Describe.h"

#include "shaders/compiler/Cost.h"
#include "shaders/compiler/GlslToSpirv.h"

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>

namespace filament_core::matinfo {
namespace {

using shader::MaterialPackage;
using shader::Variant;

constexpr std::pair<uint16_t, const char*> kBits[] = { { shader::kVariantSun, "directionalLighting" },
                                                       { shader::kVariantPunctual, "dynamicLighting" },
                                                       { shader::kVariantShadowReceiver, "shadowReceiver" },
                                                       { shader::kVariantSkinning, "skinning" },
                                                       { shader::kVariantFog, "fog" },
                                                       { shader::kVariantVsm, "vsm" },
                                                       { shader::kVariantSsr, "ssr" },
                                                       { shader::kVariantStereo, "stereo" },
                                                       { shader::kVariantHalf, "halfPrecision" },
                                                       { shader::kVariantMerged, "merged" },
                                                       { shader::kVariantDepth, "depth" },
                                                       { shader::kVariantMotion, "motion" },
                                                       { shader::kVariantDebug, "debugViews" } };

template <class E, size_t N>
const char* wordOf(E value, std::array<const char*, N> const& words) {
    const auto index = static_cast<size_t>(value);
    return index < N ? words[index] : "?";
}

std::string yesNo(bool value) { return value ? "yes" : "no"; }

void line(std::string& out, std::string_view name, std::string const& value) {
    fmt::format_to(std::back_inserter(out), "{:<22}{}\n", name, value);
}

void addWord(std::string& words, std::string_view word) {
    if (!words.empty()) words += ' ';
    words += word;
}

std::string attributes(uint32_t bits) {
    static constexpr std::array kNames{ "position", "tangents", "color",   "uv0",     "uv1",
                                        "joints",   "weights",  "custom0", "custom1", "custom2",
                                        "custom3",  "custom4",  "custom5", "custom6", "custom7" };
    std::string text;
    for (size_t i = 0; i < kNames.size(); ++i) {
        if ((bits >> i & 1) != 0) addWord(text, kNames[i]);
    }
    return text.empty() ? "none" : text;
}

void describeHead(std::string& out, MaterialPackage const& package, size_t fileBytes) {
    static constexpr std::array kModels{ "unlit", "lit", "subsurface", "cloth", "specularGlossiness" };
    static constexpr std::array kBlendings{ "opaque", "masked",   "transparent", "fade",
                                            "add",    "multiply", "screen",      "custom" };
    static constexpr std::array kDomains{ "surface", "postprocess" };
    line(out, "name", package.name.empty() ? "(none)" : package.name);
    line(out, "size", fmt::format("{} bytes", fileBytes));
    line(out, "domain", wordOf(package.domain, kDomains));
    line(out, "shadingModel", wordOf(package.shading, kModels));
    line(out, "blending", wordOf(package.blending, kBlendings));
    line(out, "featureLevel", fmt::format("{}", package.featureLevel));
    line(out, "doubleSided", yesNo(package.doubleSided));
    line(out, "depthWrite", yesNo(package.depthWrite));
    line(out, "depthCulling", yesNo(package.depthCulling));
    line(out, "attributes", attributes(package.requiredAttributes));
    line(out, "parameter block", fmt::format("{} bytes", package.uniformBytes));
    std::string terms;
    for (std::string const& term : package.terms) addWord(terms, term);
    line(out, "terms", terms.empty() ? "none" : terms);
}

void describeParameters(std::string& out, MaterialPackage const& package) {
    out += fmt::format("\n{} parameters\n", package.parameters.size());
    for (shader::Parameter const& parameter : package.parameters) {
        const std::string array = parameter.arraySize > 0 ? fmt::format("[{}]", parameter.arraySize) : "";
        const std::string place = shader::isTexture(parameter.type) ? fmt::format("binding {}", parameter.binding)
                                                                    : fmt::format("offset {}", parameter.offset);
        out += fmt::format("  {:<20}{:<32}{}\n", std::string(toString(parameter.type)) + array, parameter.name, place);
    }
    out += fmt::format("\n{} constants\n", package.constants.size());
    for (shader::Constant const& constant : package.constants) {
        static constexpr std::array kTypes{ "bool", "int", "float" };
        using Type = backend::ConstantValue::Type;
        std::string value = fmt::format("{}", static_cast<int32_t>(constant.defaultBits));
        if (constant.type == Type::Bool) value = constant.defaultBits != 0 ? "true" : "false";
        if (constant.type == Type::Float) value = fmt::format("{}", std::bit_cast<float>(constant.defaultBits));
        out += fmt::format("  {:<20}{:<32}id {}, default {}\n", wordOf(constant.type, kTypes), constant.name,
                           constant.id, value);
    }
}

uint32_t operations(std::vector<uint32_t> const& spirv) {
    return spirv.empty() ? 0 : shader::countInstructions(spirv).sum();
}

void describeVariants(std::string& out, MaterialPackage const& package) {
    out += fmt::format("\n{} variants; bytes and operations of their stages\n", package.variants.size());
    out += fmt::format("  {:>5} {:>10} {:>10} {:>10} {:>10} {:>8} {:>8}  {}\n", "key", "vertex SPV", "fragm. SPV",
                       "vert. ESSL", "frag. ESSL", "vert. op", "frag. op", "for");
    for (Variant const& each : package.variants) {
        out += fmt::format("  {:>5} {:>10} {:>10} {:>10} {:>10} {:>8} {:>8}  {}\n", each.key,
                           each.vertex->spirv.size() * 4, each.fragment->spirv.size() * 4, each.vertex->essl.size(),
                           each.fragment->essl.size(), operations(each.vertex->spirv), operations(each.fragment->spirv),
                           variantName(each.key));
    }
}

} // namespace

std::string variantName(uint32_t key) {
    std::string names;
    for (auto const& [bit, name] : kBits) {
        if ((key & bit) != 0) addWord(names, name);
    }
    return names.empty() ? "no lights" : names;
}

std::string describe(MaterialPackage const& package, size_t fileBytes) {
    std::string out;
    describeHead(out, package, fileBytes);
    describeParameters(out, package);
    describeVariants(out, package);
    return out;
}

Result<std::string> codeOf(MaterialPackage const& package, uint32_t key, Stage stage, Language language) {
    Variant const* variant = package.findVariant(key);
    if (!variant)
        return fail(ErrorCode::NotFound, "the package has no variant {}; without --variant, matinfo lists them", key);
    std::vector<uint32_t> const& spirv = stage == Stage::Vertex ? variant->vertex->spirv : variant->fragment->spirv;
    std::string const& essl = stage == Stage::Vertex ? variant->vertex->essl : variant->fragment->essl;
    const bool isMissing = language == Language::Spirv ? spirv.empty() : essl.empty();
    if (isMissing)
        return fail(ErrorCode::NotFound, "the package was compiled without this language; compile it with matc -a all");
    if (language == Language::Essl) return essl;
    return shader::disassembleSpirv(spirv);
}

} // namespace filament_core::matinfo
