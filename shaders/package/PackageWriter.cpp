// SPDX-License-Identifier: Apache-2.0
#include "base/Hash.h"
#include "shaders/package/Compression.h"
#include "shaders/package/Package.h"
#include "shaders/package/PackageFormat.h"

#include <bit>
#include <map>
#include <string>
#include <string_view>

namespace filament_core::shader {
namespace {

using namespace format;

class ByteWriter {
public:
    void u8(uint32_t value) { mBytes.push_back(static_cast<std::byte>(value)); }
    template <class E>
    void enumerator(E value) {
        u8(static_cast<uint32_t>(value));
    }
    void u16(uint32_t value) {
        u8(value & 0xFF);
        u8(value >> 8 & 0xFF);
    }
    void u32(uint32_t value) {
        for (int shift = 0; shift < 32; shift += 8) u8(value >> shift & 0xFF);
    }
    void u64(uint64_t value) {
        u32(static_cast<uint32_t>(value));
        u32(static_cast<uint32_t>(value >> 32));
    }
    void f32(float value) { u32(std::bit_cast<uint32_t>(value)); }
    void text(std::string_view value) {
        u32(static_cast<uint32_t>(value.size()));
        append(std::as_bytes(std::span(value)));
    }
    void append(std::span<const std::byte> bytes) { mBytes.insert(mBytes.end(), bytes.begin(), bytes.end()); }
    void section(uint32_t tag, ByteWriter const& content) {
        u32(tag);
        u32(static_cast<uint32_t>(content.mBytes.size()));
        append(content.mBytes);
    }
    std::vector<std::byte> const& bytes() const { return mBytes; }

private:
    std::vector<std::byte> mBytes;
};

void writeBlending(ByteWriter& out, MaterialPackage const& package) {
    out.enumerator(package.blending);
    out.enumerator(package.blendFunction.sourceColor);
    out.enumerator(package.blendFunction.sourceAlpha);
    out.enumerator(package.blendFunction.targetColor);
    out.enumerator(package.blendFunction.targetAlpha);
    out.enumerator(package.postLightingBlending);
    out.enumerator(package.transparency);
    out.enumerator(package.refractionMode);
    out.enumerator(package.refractionType);
    out.enumerator(package.reflections);
}

ByteWriter generalSection(MaterialPackage const& package) {
    ByteWriter out;
    out.text(package.name);
    out.enumerator(package.domain);
    out.enumerator(package.shading);
    out.enumerator(package.quality);
    out.u8(package.featureLevel);
    writeBlending(out, package);
    out.enumerator(package.culling);
    out.enumerator(package.vertexDomain);
    out.enumerator(package.interpolation);
    for (const bool flag :
         { package.doubleSided, package.colorWrite, package.depthWrite, package.depthCulling, package.alphaToCoverage,
           package.instanced, package.vertexDomainDeviceJittered, package.shadowMultiplier, package.transparentShadow,
           package.depthReadsParameters, package.readsFrame })
        out.u8(flag);
    out.f32(package.maskThreshold);
    out.u16(static_cast<uint16_t>(package.filteredVariants | (package.sectionPlanes ? format::kSectionPlanesFlag : 0)));
    out.u32(package.requiredAttributes);
    out.u32(package.uniformBytes);
    return out;
}

ByteWriter parameterSection(std::span<const Parameter> parameters) {
    ByteWriter out;
    out.u32(static_cast<uint32_t>(parameters.size()));
    for (Parameter const& parameter : parameters) {
        out.text(parameter.name);
        out.u8(static_cast<uint32_t>(parameter.type));
        out.u32(parameter.arraySize);
        out.u32(parameter.offset);
        out.u8(parameter.binding);
        out.enumerator(parameter.format);
        out.u8(parameter.currentPixel);
        out.u32(static_cast<uint32_t>(parameter.usedIf.size()));
        for (const uint32_t constant : parameter.usedIf) out.u32(constant);
        out.enumerator(parameter.precision);
    }
    return out;
}

ByteWriter constantSection(std::span<const Constant> constants) {
    ByteWriter out;
    out.u32(static_cast<uint32_t>(constants.size()));
    for (Constant const& constant : constants) {
        out.text(constant.name);
        out.u32(constant.id);
        out.u8(static_cast<uint32_t>(constant.type));
        out.u32(constant.defaultBits);
    }
    return out;
}

ByteWriter termSection(std::span<const std::string> terms) {
    ByteWriter out;
    out.u32(static_cast<uint32_t>(terms.size()));
    for (std::string const& term : terms) out.text(term);
    return out;
}

ByteWriter layoutSection(backend::ProgramLayout const& layout) {
    ByteWriter out;
    out.u8(static_cast<uint32_t>(layout.size()));
    for (backend::BindGroupLayout const& group : layout) {
        out.u8(group.count);
        for (uint32_t i = 0; i < group.count; ++i) {
            out.u8(group.bindings[i].binding);
            out.u8(static_cast<uint32_t>(group.bindings[i].type));
            out.u8(static_cast<uint32_t>(group.bindings[i].stages));
            out.u8(group.bindings[i].inputAttachment);
        }
    }
    return out;
}

/// The code of the stages; each distinct text once, in the order in which variants first use it.
class CodePool {
public:
    uint32_t add(std::span<const uint32_t> spirv) {
        ByteWriter words;
        for (const uint32_t word : spirv) words.u32(word);
        return add(std::string_view(reinterpret_cast<const char*>(words.bytes().data()), words.bytes().size()));
    }
    uint32_t add(std::string_view code) {
        const auto [at, isNew] = mIndices.emplace(code, static_cast<uint32_t>(mIndices.size()));
        if (isNew) mCode.text(code);
        return at->second;
    }
    ByteWriter section() const {
        ByteWriter out;
        out.u32(static_cast<uint32_t>(mIndices.size()));
        out.append(mCode.bytes());
        return out;
    }

private:
    std::map<std::string, uint32_t, std::less<>> mIndices;
    ByteWriter mCode;
};

ByteWriter variantSection(std::span<const Variant> variants, CodePool& code) {
    ByteWriter out;
    out.u32(static_cast<uint32_t>(variants.size()));
    for (Variant const& variant : variants) {
        out.u16(variant.key);
        for (SharedStage const& stage : { variant.vertex, variant.fragment }) {
            out.u32(code.add(stage->spirv));
            out.u32(code.add(stage->essl));
        }
    }
    return out;
}

} // namespace

std::vector<std::byte> writePackage(MaterialPackage const& package) {
    ByteWriter sections;
    sections.section(kSectionGeneral, generalSection(package));
    sections.section(kSectionParameters, parameterSection(package.parameters));
    sections.section(kSectionConstants, constantSection(package.constants));
    sections.section(kSectionTerms, termSection(package.terms));
    sections.section(kSectionLayout, layoutSection(package.layout));
    CodePool code;
    const ByteWriter variants = variantSection(package.variants, code);
    ByteWriter packed;
    packed.append(compressBytes(code.section().bytes()));
    sections.section(kSectionCode, packed);
    sections.section(kSectionVariants, variants);

    ByteWriter file;
    file.u32(kMagic);
    file.u32(kVersion);
    file.u64(hashBytes(sections.bytes()));
    file.append(sections.bytes());
    return file.bytes();
}

} // namespace filament_core::shader
