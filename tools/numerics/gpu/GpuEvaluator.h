// SPDX-License-Identifier: Apache-2.0
/// GpuEvaluator: evaluates rows at points in the fragment shaders of one device.
///   In      any number of rows with their points; groups of 8 rows share a program and a draw.
///   Out     one list of results per row, exactly as the device returned them, including infinities and NaN.
///   Thread  the one that created it. Memory: 64 B per point on the device while evaluate() runs.
///   Fails   make(): the driver's reason. evaluate(): the compiler's or the device's.
///   Cost    0.2 s per group if the driver has not cached its program, milliseconds with MESA_SHADER_CACHE_DIR.
#pragma once

#include "backend/create/CreateDriver.h"
#include "backend/stream/CommandStream.h"
#include "tools/numerics/table/Measure.h"

#include <memory>
#include <vector>

namespace filament_core::shader::numerics {

struct Task {
    Row const* row = nullptr;
    std::vector<Point> points;
};

class GpuEvaluator {
public:
    /// `library`: the text of shaders/lib (ShaderText.h).
    static Result<std::unique_ptr<GpuEvaluator>> make(Backend type, std::string library);

    /// "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6"
    std::string deviceName() const;
    /// Whether the device supports 16-bit arithmetic.
    bool hasHalf() const { return mStream->info().features.halfFloatShaders; }
    Result<std::vector<Results>> evaluate(std::span<const Task> tasks, Format format);

private:
    struct Group;

    GpuEvaluator(std::unique_ptr<backend::CommandStream> stream, std::string library)
            : mStream(std::move(stream)), mLibrary(std::move(library)) {}

    Result<void> evaluateGroup(std::span<const Task> tasks, Format format, std::vector<Results>& results);
    backend::TextureHandle createTexture(backend::CommandBuffer& commands, Group const& group,
                                         std::span<const glm::vec4> texels);
    void draw(backend::CommandBuffer& commands, Group const& group);
    Result<std::vector<glm::vec4>> read(Group const& group);

    std::unique_ptr<backend::CommandStream> mStream;
    std::string mLibrary;
    backend::SamplerHandle mNearest;
};

} // namespace filament_core::shader::numerics
