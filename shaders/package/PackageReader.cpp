// SPDX-License-Identifier: Apache-2.0
#include "base/Hash.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/ByteReader.h"
#include "shaders/package/Compression.h"
#include "shaders/package/Package.h"
#include "shaders/package/PackageError.h"
#include "shaders/package/PackageFormat.h"
#include "shaders/package/ParameterLayout.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace filament_core::shader {
namespace {

using namespace format;
using Sections = std::map<uint32_t, std::span<const std::byte>>;

/// Sets `value` if the byte is one of the enumerators up to `last`.
template <class E>
bool readEnum(ByteReader& in, E& value, E last) {
    const uint8_t raw = in.u8();
    value = static_cast<E>(raw);
    return raw <= static_cast<uint8_t>(last);
}

bool readBool(ByteReader& in, bool& value) {
    const uint8_t raw = in.u8();
    value = raw != 0;
    return raw <= 1;
}

// ---------------------------------------------------------------------------------------------- file and sections

Result<std::span<const std::byte>> checkHeader(std::span<const std::byte> bytes) {
    ByteReader in(bytes);
    if (in.u32() != kMagic || in.failed()) return corruptPackage("this is not a material package (wrong magic)");
    const uint32_t version = in.u32();
    const uint64_t checksum = in.u64();
    if (in.failed()) return corruptPackage("the file ends within its header");
    if (version != kVersion) {
        return fail(ErrorCode::Unsupported,
                    "material package: version {} is not version {} of this engine; compile the "
                    "material again with the matc of this engine",
                    version, kVersion);
    }
    const auto content = bytes.subspan(kHeaderBytes);
    if (hashBytes(content) != checksum)
        return corruptPackage("the checksum does not match, the file is damaged or cut short");
    return content;
}

Result<Sections> splitSections(std::span<const std::byte> content) {
    Sections sections;
    ByteReader in(content);
    while (!in.atEnd()) {
        const uint32_t tag = in.u32();
        const auto body = in.bytes(in.u32());
        if (in.failed()) return corruptPackage("a section is longer than the file");
        if (!sections.emplace(tag, body).second) return corruptPackage("a section appears twice");
    }
    for (const uint32_t tag : { kSectionGeneral, kSectionParameters, kSectionConstants, kSectionTerms, kSectionLayout,
                                kSectionCode, kSectionVariants }) {
        if (!sections.contains(tag)) return corruptPackage("a required section is missing");
    }
    return sections;
}

// ---------------------------------------------------------------------------------------------- one function per
// section

bool readBlending(ByteReader& in, MaterialPackage& out) {
    constexpr auto kLast = backend::BlendFactor::SrcAlphaSaturate;
    BlendFunction& function = out.blendFunction;
    return readEnum(in, out.blending, Blending::Custom) && readEnum(in, function.sourceColor, kLast) &&
           readEnum(in, function.sourceAlpha, kLast) && readEnum(in, function.targetColor, kLast) &&
           readEnum(in, function.targetAlpha, kLast) &&
           readEnum(in, out.postLightingBlending, PostLightingBlending::Screen) &&
           readEnum(in, out.transparency, TransparencyMode::TwoPassesTwoSides) &&
           readEnum(in, out.refractionMode, RefractionMode::ScreenSpace) &&
           readEnum(in, out.refractionType, RefractionType::Thin) &&
           readEnum(in, out.reflections, Reflections::ScreenSpace);
}

bool readRaster(ByteReader& in, MaterialPackage& out) {
    return readEnum(in, out.culling, Culling::FrontAndBack) && readEnum(in, out.vertexDomain, VertexDomain::Device) &&
           readEnum(in, out.interpolation, Interpolation::Flat);
}

bool readFlags(ByteReader& in, MaterialPackage& out) {
    return readBool(in, out.doubleSided) && readBool(in, out.colorWrite) && readBool(in, out.depthWrite) &&
           readBool(in, out.depthCulling) && readBool(in, out.alphaToCoverage) && readBool(in, out.instanced) &&
           readBool(in, out.vertexDomainDeviceJittered) && readBool(in, out.shadowMultiplier) &&
           readBool(in, out.transparentShadow) && readBool(in, out.depthReadsParameters) &&
           readBool(in, out.readsFrame);
}

bool readGeneral(ByteReader in, MaterialPackage& out) {
    out.name = in.text();
    const bool models = readEnum(in, out.domain, MaterialDomain::PostProcess) &&
                        readEnum(in, out.shading, ShadingModel::SpecularGlossiness) &&
                        readEnum(in, out.quality, MaterialQuality::High);
    out.featureLevel = in.u8();
    const bool state = models && readBlending(in, out) && readRaster(in, out) && readFlags(in, out);
    out.maskThreshold = in.f32();
    const uint16_t variants = in.u16();
    out.filteredVariants = variants & static_cast<uint16_t>(~format::kSectionPlanesFlag);
    out.sectionPlanes = (variants & format::kSectionPlanesFlag) != 0;
    out.requiredAttributes = in.u32();
    out.uniformBytes = in.u32();
    const bool level = out.featureLevel >= 1 && out.featureLevel <= 3;
    const bool threshold = out.maskThreshold >= 0 && out.maskThreshold <= 1; // false for NaN
    const bool bits = out.requiredAttributes < 1u << backend::kMaxVertexAttributes &&
                      (out.filteredVariants & ~kAllVariantBits) == 0;
    return state && level && threshold && bits && out.uniformBytes % 16 == 0 && in.atEnd() && !in.failed();
}

bool readParameters(ByteReader in, std::vector<Parameter>& out) {
    const uint32_t count = in.u32();
    if (count > kMaxParameters) return false;
    for (uint32_t i = 0; i < count && !in.failed(); ++i) {
        Parameter parameter;
        parameter.name = in.text();
        if (!readEnum(in, parameter.type, ParameterType::Sampler3D)) return false;
        parameter.arraySize = in.u32();
        parameter.offset = in.u32();
        parameter.binding = in.u8();
        if (!readEnum(in, parameter.format, SamplerFormat::Uint)) return false;
        if (!readBool(in, parameter.currentPixel)) return false;
        const uint32_t conditions = in.u32();
        if (conditions > kMaxConstants) return false;
        for (uint32_t c = 0; c < conditions && !in.failed(); ++c) parameter.usedIf.push_back(in.u32());
        if (!readEnum(in, parameter.precision, Precision::High)) return false;
        out.push_back(std::move(parameter));
    }
    return in.atEnd() && !in.failed();
}

bool readConstants(ByteReader in, std::vector<Constant>& out) {
    const uint32_t count = in.u32();
    if (count > kMaxConstants) return false;
    for (uint32_t i = 0; i < count && !in.failed(); ++i) {
        Constant constant;
        constant.name = in.text();
        constant.id = in.u32();
        if (!readEnum(in, constant.type, backend::ConstantValue::Type::Float)) return false;
        constant.defaultBits = in.u32();
        out.push_back(std::move(constant));
    }
    return in.atEnd() && !in.failed();
}

bool readTerms(ByteReader in, std::vector<std::string>& out) {
    const uint32_t count = in.u32();
    if (count > kMaxTerms) return false;
    for (uint32_t i = 0; i < count && !in.failed(); ++i) out.push_back(in.text());
    return in.atEnd() && !in.failed();
}

bool readGroup(ByteReader& in, backend::BindGroupLayout& group) {
    group.count = in.u8();
    if (group.count > backend::kMaxBindings) return false;
    for (uint32_t i = 0; i < group.count; ++i) {
        backend::BindingDesc& at = group.bindings[i];
        at.binding = in.u8();
        const bool type = readEnum(in, at.type, backend::BindingType::StorageBuffer);
        const bool stages = readEnum(in, at.stages, backend::ShaderStage::Both) && at.stages != backend::ShaderStage{};
        at.inputAttachment = in.u8();
        const bool ascends = i == 0 || at.binding > group.bindings[i - 1].binding;
        const bool inRange = at.binding < backend::kMaxBindings && at.inputAttachment < backend::kMaxColorAttachments;
        if (!type || !stages || !ascends || !inRange) return false;
    }
    return group.dynamicCount() <= backend::kMaxDynamicOffsets;
}

bool readLayout(ByteReader in, backend::ProgramLayout& out) {
    if (in.u8() != out.size()) return false;
    for (backend::BindGroupLayout& group : out) {
        if (!readGroup(in, group)) return false;
    }
    return in.atEnd() && !in.failed();
}

using Code = std::vector<std::span<const std::byte>>;

bool readCode(ByteReader in, Code& out) {
    const uint32_t count = in.u32();
    if (count > 4 * kMaxVariants) return false;
    for (uint32_t i = 0; i < count && !in.failed(); ++i) out.push_back(in.bytes(in.u32()));
    return in.atEnd() && !in.failed();
}

/// Returns stages, each of which is made once, provided that their code exists and together has no more than
/// `bytesLeft`.
class StageReader {
public:
    StageReader(Code const& code, size_t bytesLeft) : mCode(code), mBytesLeft(bytesLeft) {}

    SharedStage stage(ByteReader& in, bool& good) {
        const uint32_t spirv = in.u32(), essl = in.u32();
        const auto known = mStages.find({ spirv, essl });
        if (known != mStages.end()) return known->second;
        StageCode code;
        code.spirv = words(piece(spirv, good), good);
        const auto text = piece(essl, good);
        code.essl.assign(reinterpret_cast<const char*>(text.data()), text.size());
        if (!good) return sharedStage({});
        return mStages[{ spirv, essl }] = sharedStage(std::move(code));
    }

private:
    std::span<const std::byte> piece(uint32_t index, bool& good) {
        good = good && index < mCode.size() && mCode[index].size() <= mBytesLeft;
        if (!good) return {};
        mBytesLeft -= mCode[index].size();
        return mCode[index];
    }
    static std::vector<uint32_t> words(std::span<const std::byte> bytes, bool& good) {
        good = good && bytes.size() % 4 == 0;
        ByteReader from(bytes);
        std::vector<uint32_t> values(good ? bytes.size() / 4 : 0);
        for (uint32_t& value : values) value = from.u32();
        return values;
    }

    Code const& mCode;
    size_t mBytesLeft;
    std::map<std::pair<uint32_t, uint32_t>, SharedStage> mStages;
};

bool readVariants(ByteReader in, StageReader stages, std::vector<Variant>& out) {
    const uint32_t count = in.u32();
    if (count > kMaxVariants) return false;
    bool good = true;
    for (uint32_t i = 0; i < count && good && !in.failed(); ++i) {
        Variant variant;
        variant.key = in.u16();
        variant.vertex = stages.stage(in, good);
        variant.fragment = stages.stage(in, good);
        if ((variant.key & ~kAllVariantBits) != 0) return false;
        if (!out.empty() && variant.key <= out.back().key) return false;
        out.push_back(std::move(variant));
    }
    return good && in.atEnd() && !in.failed();
}

// ---------------------------------------------------------------------------------------------- consistency of the
// parts

template <class T>
bool namesAreUnique(std::vector<T> const& things) {
    std::set<std::string_view> names;
    return std::ranges::all_of(things,
                               [&](T const& thing) { return !thing.name.empty() && names.insert(thing.name).second; });
}

bool fits(Parameter const& parameter, uint32_t uniformBytes) {
    if (parameter.currentPixel && parameter.type != ParameterType::Sampler2D) return false;
    if (isTexture(parameter.type)) return parameter.arraySize == 0 && parameter.binding < backend::kMaxBindings;
    const uint32_t alignment = parameter.arraySize > 0 ? 16 : valueAlignment(parameter.type);
    return parameter.offset % alignment == 0 && parameter.offset + parameterBytes(parameter) <= uniformBytes;
}

/// Follows from the types, so the file does not have it.
void markMultisampled(MaterialPackage& package) {
    backend::BindGroupLayout& group = package.layout[kGroupMaterial];
    for (backend::BindingDesc& binding : std::span(group.bindings).first(group.count)) {
        const auto found = std::ranges::find_if(package.parameters, [&](Parameter const& parameter) {
            return isTexture(parameter.type) && parameter.binding == binding.binding;
        });
        binding.isMultisampled = binding.type == backend::BindingType::SampledTexture &&
                                 found != package.parameters.end() && found->type == ParameterType::Sampler2DMS;
    }
}

bool isBoolConstant(MaterialPackage const& package, uint32_t id) {
    const auto found = std::ranges::find(package.constants, id, &Constant::id);
    return found != package.constants.end() && found->type == backend::ConstantValue::Type::Bool;
}

Result<void> checkConsistency(MaterialPackage const& package) {
    if (!namesAreUnique(package.parameters))
        return corruptPackage("two parameters have the same name, or one has none");
    if (!namesAreUnique(package.constants)) return corruptPackage("two constants have the same name, or one has none");
    for (Parameter const& parameter : package.parameters) {
        if (!std::ranges::all_of(parameter.usedIf, [&](uint32_t id) { return isBoolConstant(package, id); }))
            return corruptPackage("a texture depends on something that is no bool constant");
        if (!fits(parameter, package.uniformBytes))
            return corruptPackage(
                    "a parameter lies outside of its block, or is read in a way that its type does not have");
    }
    return {};
}

} // namespace

Result<MaterialPackage> readPackage(std::span<const std::byte> bytes) {
    const Result<std::span<const std::byte>> content = checkHeader(bytes);
    if (!content) return content.error();
    Result<Sections> sections = splitSections(*content);
    if (!sections) return sections.error();
    const auto section = [&](uint32_t tag) { return ByteReader((*sections)[tag]); };

    MaterialPackage package;
    if (!readGeneral(section(kSectionGeneral), package)) return corruptPackage("the general section is malformed");
    if (!readParameters(section(kSectionParameters), package.parameters))
        return corruptPackage("the parameters are malformed");
    if (!readConstants(section(kSectionConstants), package.constants))
        return corruptPackage("the constants are malformed");
    if (!readTerms(section(kSectionTerms), package.terms)) return corruptPackage("the terms are malformed");
    if (!readLayout(section(kSectionLayout), package.layout)) return corruptPackage("the binding layout is malformed");
    const Result<std::vector<std::byte>> unpacked = decompressBytes((*sections)[kSectionCode], kMaxCodeBytes);
    if (!unpacked) return unpacked.error();
    Code code;
    if (!readCode(ByteReader(*unpacked), code)) return corruptPackage("the code of the variants is malformed");
    if (!readVariants(section(kSectionVariants), StageReader(code, kMaxCodeBytes), package.variants))
        return corruptPackage("the variants are malformed");
    if (Result<void> consistent = checkConsistency(package); !consistent) return consistent.error();
    markMultisampled(package);
    return package;
}

} // namespace filament_core::shader
