// SPDX-License-Identifier: Apache-2.0
#include "tools/view/ui/UiRenderer.h"

#include "tools/view/ui/ImGuiVersions.h"

#include <materials/ui.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace filament_core::view {
namespace {

constexpr size_t kLeastVertices = 4096, kLeastIndices = 8192;

/// Everything that is drawn lies in it; the device domain knows no other place.
constexpr Box kDeviceBox{ double3(-1), double3(1) };

ImTextureID textureId(size_t slot, uint32_t generation) {
    return textureIdOf(uint64_t{ generation } << 32 | (slot + 1));
}

/// What the view makes of numbers: nothing.
View interfaceView(uint2 size) {
    View view{ .size = size, .clearColor = float4(0) };
    view.display = { .toneMapper = ToneMapper::Linear, .outputSpace = OutputSpace::LinearRec709 };
    view.viewport = Viewport{ .contents = TargetContents::Keep, .blending = ViewBlending::Translucent };
    return view;
}

template <class T>
std::span<const std::byte> contents(std::vector<T> const& values) {
    return std::as_bytes(std::span(values));
}

} // namespace

Result<UiRenderer> UiRenderer::create(Engine& engine) {
    const Result<Material> material = engine.create(MaterialDesc{ .package = materials::ui() });
    if (!material) return material.error();
    return UiRenderer(engine, engine.own(*material));
}

UiRenderer::UiRenderer(Engine& engine, Owned<Material> material)
        : mEngine(&engine), mMaterial(std::move(material)), mScene(std::make_unique<Scene>(engine)),
          mRenderer(std::make_unique<Renderer>(engine)) {}

void UiRenderer::uploadFonts(ImFontAtlas& fonts) {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    fonts.GetTexDataAsRGBA32(&pixels, &width, &height);
    const size_t size = static_cast<size_t>(width) * static_cast<size_t>(height) * 4;
    Owned<Texture> atlas = mEngine->own(mEngine->create(TextureDesc{ .format = Format::RGBA8,
                                                                     .width = static_cast<uint32_t>(width),
                                                                     .height = static_cast<uint32_t>(height),
                                                                     .pixels = std::as_bytes(std::span(pixels, size)),
                                                                     .name = "interface fonts" }));
    if (mFontsId) remove(mFontsId);
    mFonts = std::move(atlas);
    mFontsId = mFonts.get() ? add(mFonts, Sampler{ .mipFilter = MipFilter::None,
                                                   .wrapU = WrapMode::ClampToEdge,
                                                   .wrapV = WrapMode::ClampToEdge })
                            : ImTextureID{};
    fonts.SetTexID(mFontsId);
}

ImTextureID UiRenderer::add(Texture texture, Sampler sampler) {
    Owned<MaterialInstance> instance = mEngine->own(mEngine->createInstance(mMaterial, "interface"));
    if (!instance.get() || !mEngine->set(instance, "picture", texture, sampler)) return {};
    const auto free = std::find_if(mSlots.begin(), mSlots.end(), [](Slot const& slot) { return !slot.instance.get(); });
    const auto slot = static_cast<size_t>(free - mSlots.begin());
    if (free == mSlots.end()) mSlots.emplace_back();
    mSlots[slot].instance = std::move(instance);
    return textureId(slot, ++mSlots[slot].generation);
}

void UiRenderer::remove(ImTextureID id) {
    for (size_t i = 0; i < mSlots.size(); ++i)
        if (mSlots[i].instance.get() && textureId(i, mSlots[i].generation) == id) mSlots[i].instance.reset();
}

MaterialInstance UiRenderer::materialOf(ImTextureID id) const {
    const uint64_t bits = bitsOfTexture(id);
    const size_t slot = (bits & 0xFFFFFFFF) - 1; // of 0: beyond all
    if (slot >= mSlots.size() || bits >> 32 != mSlots[slot].generation) return {};
    return mSlots[slot].instance.get();
}

void UiRenderer::render(ImDrawData const& drawData, SwapChain target, uint2 targetSize) {
    mGeometry.build(drawData);
    mStatistics.vertices = static_cast<uint32_t>(mGeometry.vertices().size());
    mStatistics.indices = static_cast<uint32_t>(mGeometry.indices().size());
    mStatistics.skippedTriangles = mGeometry.skippedTriangles();
    mStatistics.draws = 0;
    if (mGeometry.indices().empty() || uiPixels(drawData) != targetSize) return;
    if (!(mGeometry == mUploaded)) {
        if (!upload()) return;
        std::swap(mGeometry, mUploaded);
    }
    show();
    if (mStatistics.draws > 0) mRenderer->render(*mScene, interfaceView(targetSize), target);
}

bool UiRenderer::upload() {
    if ((mGeometry.vertices().size() > mVertexCapacity || mGeometry.indices().size() > mIndexCapacity) &&
        !growBuffers()) {
        return false;
    }
    mEngine->update(mVertices, contents(mGeometry.vertices()));
    mEngine->update(mIndices, contents(mGeometry.indices()));
    ++mStatistics.uploads;
    return true;
}

bool UiRenderer::growBuffers() {
    const size_t vertices = std::bit_ceil(std::max(kLeastVertices, mGeometry.vertices().size()));
    const size_t indices = std::bit_ceil(std::max(kLeastIndices, mGeometry.indices().size()));
    const std::vector<std::byte> nothing(std::max(vertices * sizeof(UiVertex), indices * sizeof(uint32_t)));
    const std::span<const std::byte> zeros(nothing);
    Owned<VertexBuffer> vertexBuffer =
            mEngine->own(mEngine->create(VertexBufferDesc{ .vertexCount = static_cast<uint32_t>(vertices),
                                                           .stride = sizeof(UiVertex),
                                                           .attributes = uiVertexAttributes(),
                                                           .data = zeros.first(vertices * sizeof(UiVertex)),
                                                           .name = "interface vertices" }));
    Owned<IndexBuffer> indexBuffer =
            mEngine->own(mEngine->create(IndexBufferDesc{ .indexCount = static_cast<uint32_t>(indices),
                                                          .format = IndexFormat::UInt32,
                                                          .data = zeros.first(indices * sizeof(uint32_t)),
                                                          .name = "interface indices" }));
    if (!vertexBuffer.get() || !indexBuffer.get()) return false;
    mVertices = std::move(vertexBuffer);
    mIndices = std::move(indexBuffer);
    mVertexCapacity = vertices;
    mIndexCapacity = indices;
    for (Shown& shown : mShown) shown.run = {}; // what they show lies in the old ones
    ++mStatistics.bufferGrowths;
    return true;
}

void UiRenderer::show() {
    size_t place = 0;
    for (UiRun const& run : mUploaded.runs()) {
        if (const MaterialInstance material = materialOf(run.texture))
            showRun(place++, run, material);
        else
            mStatistics.skippedTriangles += run.indexCount / 3;
    }
    mStatistics.draws = static_cast<uint32_t>(place);
    for (; place < mShown.size() && mShown[place].isVisible; ++place) {
        mScene->setVisible(mShown[place].renderable, false);
        mShown[place].isVisible = false;
    }
}

void UiRenderer::showRun(size_t place, UiRun const& run, MaterialInstance material) {
    if (place == mShown.size()) {
        mShown.push_back({ mScene->add({ .vertices = mVertices,
                                         .indices = mIndices,
                                         .material = material,
                                         .firstIndex = run.firstIndex,
                                         .indexCount = run.indexCount,
                                         .bounds = kDeviceBox,
                                         .culled = false,
                                         .castsShadows = false,
                                         .drawOrder = { .blendOrder = static_cast<uint16_t>(place) } }),
                           run, material, true });
        return;
    }
    Shown& shown = mShown[place];
    if (shown.run != run)
        mScene->setGeometry(shown.renderable, { .vertices = mVertices,
                                                .indices = mIndices,
                                                .firstIndex = run.firstIndex,
                                                .indexCount = run.indexCount,
                                                .bounds = kDeviceBox });
    if (shown.material != material) mScene->setMaterial(shown.renderable, material);
    if (!shown.isVisible) mScene->setVisible(shown.renderable, true);
    shown = { shown.renderable, run, material, true };
}

} // namespace filament_core::view
