// SPDX-License-Identifier: Apache-2.0
// Light images: pixels -> the words that shaders read.
#include <filament_core/LightImage.h>

#include "base/OutOfMemory.h"
#include "filament_core/assets/tables/LightImageTable.h"
#include "filament_core/engine/EngineImpl.h"
#include "shaders/interface/ShaderInterface.h"

#include <filament_core/Image.h>
#include <filament_core/TexelBytes.h>

#include <algorithm>

namespace filament_core {

using engine::PublicCall;

namespace {

constexpr uint32_t kMaxPixels = 16384; // of a side
static_assert(assets::kLightImageHeaderWords == shader::kImageHeaderWords);

bool isLightFormat(Format format) {
    return format == Format::RGBA8 || format == Format::RGBA8Srgb || format == Format::RGBA16F ||
           format == Format::RGBA32F;
}

void checkDesc(LightImageDesc const& desc) {
    FILAMENT_ASSERT(desc.width >= 1 && desc.height >= 1 && desc.width <= kMaxPixels && desc.height <= kMaxPixels,
                    "the sides of a light image are 1 to 16384 pixels");
    const size_t bytes = texelBytes(desc.format);
    FILAMENT_ASSERT(isLightFormat(desc.format), "a light image is RGBA8, RGBA8Srgb, RGBA16F or RGBA32F");
    FILAMENT_ASSERT(desc.pixels.size() >= bytes * desc.width * desc.height, "`pixels` holds all of the light image");
}

Result<void> checkShape(LightImageDesc const& desc) {
    const std::string_view name = desc.name.empty() ? "light image" : std::string_view(desc.name);
    if (desc.shape == LightImageShape::Octahedron && desc.width != desc.height)
        return fail(ErrorCode::InvalidArgument, "{}: {} x {} pixels; an octahedral map is square", name, desc.width,
                    desc.height);
    const bool isStrip = desc.width == 6 * desc.height || desc.height == 6 * desc.width;
    if (desc.shape == LightImageShape::Cube && !isStrip)
        return fail(ErrorCode::InvalidArgument,
                    "{}: {} x {} pixels; a cube is six squares beside or below each other, so one side is six times "
                    "the other",
                    name, desc.width, desc.height);
    return {};
}

float3 meanOf(assets::LightPixels const& image) { return assets::averaged(image, 1, 1).colors[0]; }

} // namespace

Result<LightImage> Engine::create(LightImageDesc const& desc) {
    const PublicCall call(mImpl, "Engine::create(LightImageDesc)", desc.name);
    checkDesc(desc);
    if (Result<void> fits = checkShape(desc); !fits) return fits.error();
    return orOutOfMemory("light image", desc.name, [&]() -> Result<LightImage> {
        engine::Draft draft(mImpl->lightImages);
        assets::LightPixels image = assets::lightPixels(desc);
        const bool isCube = desc.shape == LightImageShape::Cube;
        if (isCube) image = assets::octahedronOfCube(image);
        const LightImageShape stored = isCube ? LightImageShape::Octahedron : desc.shape;
        auto words = std::make_shared<const std::vector<uint32_t>>(
                assets::lightImageTable(image, stored, ++mImpl->lastLightImage));
        const LightImageDescription description{ desc.shape, (*words)[0], (*words)[1], meanOf(image) };
        const float aspect = static_cast<float>(image.height) / static_cast<float>(image.width);
        draft.state() = { std::move(words), aspect, description, desc.name };
        return draft.keep();
    });
}

LightImageDescription Engine::describe(LightImage image) const {
    const PublicCall call(mImpl, "Engine::describe(LightImage)");
    return mImpl->lightImages.get(image).description;
}

Result<LightImage> loadLightImage(Engine& engine, std::filesystem::path const& path, LightImageShape shape) {
    const PublicCall call(engine, "loadLightImage(Engine, path)", path.native());
    const Result<Image> image = loadImage(path);
    if (!image) return image.error();
    return engine.create(LightImageDesc{ .width = image->width,
                                         .height = image->height,
                                         .format = image->format,
                                         .pixels = image->pixels,
                                         .shape = shape,
                                         .name = path.filename().string() });
}

} // namespace filament_core
