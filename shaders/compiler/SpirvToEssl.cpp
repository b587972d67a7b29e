// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/SpirvToEssl.h"

#include "shaders/compiler/EsslConditions.h"
#include "shaders/compiler/FetchOutputs.h"
#include "shaders/interface/ShaderInterface.h"

#include <spirv_cross/spirv_glsl.hpp>

#include <exception>
#include <utility>

namespace filament_core::shader {
namespace {

using spirv_cross::CompilerGLSL;

/// SPIRV-Cross supports `precise` only from ESSL 3.20 on. An extension adds it to 3.10; for a device without the
/// extension, which cannot promise equal bits anyway, a macro removes the word.
class EsslCompiler final : public CompilerGLSL {
public:
    explicit EsslCompiler(std::vector<uint32_t> spirv) : CompilerGLSL(std::move(spirv)) {
        for (const char* line :
             { "#extension GL_EXT_gpu_shader5 : enable", "#ifndef GL_EXT_gpu_shader5", "#define precise", "#endif" }) {
            add_header_line(line);
        }
    }

    /// Part of ESSL 3.20. A device with neither it nor the extension covers all samples.
    void nameSampleMask() {
        update_active_builtins();
        if (!has_active_builtin(spv::BuiltInSampleMask, spv::StorageClassOutput)) return;
        for (const char* line :
             { "#extension GL_OES_sample_variables : enable", "#ifdef GL_OES_sample_variables",
               "#define written_samples gl_SampleMask", "#else", "int written_samples[1];", "#endif" }) {
            add_header_line(line);
        }
    }

private:
    void emit_header() override {
        backend.support_precise_qualifier = true;
        CompilerGLSL::emit_header();
    }

    std::string builtin_to_glsl(spv::BuiltIn builtin, spv::StorageClass storage) override {
        const bool isWrittenMask = builtin == spv::BuiltInSampleMask && storage == spv::StorageClassOutput;
        return isWrittenMask ? "written_samples" : CompilerGLSL::builtin_to_glsl(builtin, storage);
    }
};

void setOptions(CompilerGLSL& compiler) {
    CompilerGLSL::Options options = compiler.get_common_options();
    options.version = 310;
    options.es = true;
    options.vulkan_semantics = false;
    options.fragment.default_float_precision = CompilerGLSL::Options::Highp;
    options.fragment.default_int_precision = CompilerGLSL::Options::Highp;
    compiler.set_common_options(options);
}

/// Without the optimiser a module declares more than it reads. Outputs stay, including the unwritten ones of
/// withFetchOutputs().
void dropUnread(CompilerGLSL& compiler) {
    auto active = compiler.get_active_interface_variables();
    for (auto const& output : compiler.get_shader_resources().stage_outputs) active.insert(output.id);
    compiler.set_enabled_interface_variables(std::move(active));
}

/// OpenGL ES numbers all blocks in one sequence and all texture units in another.
void renumber(CompilerGLSL& compiler, spirv_cross::Resource const& resource, backend::ProgramLayout const& layout) {
    const uint32_t set = compiler.get_decoration(resource.id, spv::DecorationDescriptorSet);
    const uint32_t binding = compiler.get_decoration(resource.id, spv::DecorationBinding);
    compiler.set_decoration(resource.id, spv::DecorationDescriptorSet, 0);
    compiler.set_decoration(resource.id, spv::DecorationBinding,
                            backend::flatBinding(layout, set, static_cast<uint8_t>(binding)));
}

void renumberAll(CompilerGLSL& compiler, backend::ProgramLayout const& layout) {
    const spirv_cross::ShaderResources resources =
            compiler.get_shader_resources(compiler.get_active_interface_variables());
    for (auto const& buffer : resources.uniform_buffers) renumber(compiler, buffer, layout);
    for (auto const& buffer : resources.storage_buffers) renumber(compiler, buffer, layout);
    for (auto const& image : resources.sampled_images) renumber(compiler, image, layout);
    for (auto const& input : resources.subpass_inputs) {
        const uint32_t index = compiler.get_decoration(input.id, spv::DecorationInputAttachmentIndex);
        compiler.remap_ext_framebuffer_fetch(index, index, true); // attachment i is colour attachment i of the pass
    }
}

/// passProbes has the texture unit of passSpecular, and the device may lack arrays of cubes: only programs that
/// read it declare it.
constexpr std::string_view kProbes = "passProbes";

std::string ifProbes(std::string_view lines) {
    return fmt::format("#ifdef SPIRV_CROSS_CONSTANT_ID_{0}\n#if SPIRV_CROSS_CONSTANT_ID_{0} != 0\n{1}\n#endif\n#endif",
                       uint32_t{ kQualityReflectionProbes }, lines);
}

std::string declareProbesOnDemand(std::string essl) {
    const size_t name = essl.find(fmt::format("samplerCubeArray {};\n", kProbes));
    if (name == std::string::npos) return essl;
    const size_t begin = essl.rfind('\n', name) + 1, end = essl.find('\n', name);
    return essl.replace(begin, end - begin, ifProbes(essl.substr(begin, end - begin)));
}

/// ESSL 3.20 has arrays of cubes; 3.10 has them with an extension, of which SPIRV-Cross does not know.
void requireCubeArrays(CompilerGLSL& compiler) {
    for (auto const& image : compiler.get_shader_resources(compiler.get_active_interface_variables()).sampled_images) {
        const auto type = compiler.get_type(image.type_id).image;
        if (type.dim != spv::DimCube || !type.arrayed) continue;
        constexpr std::string_view kRequire = "#extension GL_EXT_texture_cube_map_array : require";
        compiler.add_header_line(image.name == kProbes ? ifProbes(kRequire) : std::string(kRequire));
    }
}

/// Part of ESSL 3.20; SPIRV-Cross does not know that 3.10 has it with an extension.
void requirePrimitiveId(CompilerGLSL& compiler) {
    compiler.update_active_builtins();
    if (compiler.has_active_builtin(spv::BuiltInPrimitiveId, spv::StorageClassInput))
        compiler.add_header_line("#extension GL_EXT_geometry_shader : require");
}

} // namespace

Result<std::string> esslFromSpirv(std::span<const uint32_t> spirv, backend::ProgramLayout const& layout) {
    try {
        EsslCompiler compiler(withFetchOutputs(spirv));
        setOptions(compiler);
        dropUnread(compiler);
        renumberAll(compiler, layout);
        requireCubeArrays(compiler);
        requirePrimitiveId(compiler);
        compiler.nameSampleMask();
        return declareProbesOnDemand(preprocessConditions(compiler.compile()));
    } catch (std::exception const& error) {
        return fail(ErrorCode::Unsupported, "the shader cannot be expressed in ESSL 3.10: {}", error.what());
    }
}

} // namespace filament_core::shader
