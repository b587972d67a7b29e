// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/Drawables.h"

#include "base/Assert.h"
#include "base/Hash.h"
#include "filament_core/scene/OccluderMesh.h"

namespace filament_core::scene {
namespace {

uint32_t depthOrder(MaterialInstance const& instance) {
    if (instance.material->isBlended()) return Drawables::kBlendedOrder;
    const bool readsSceneColor = instance.material->package.refractionMode == shader::RefractionMode::ScreenSpace;
    const bool writesStencil = instance.raster.stencil && instance.raster.stencil->writes();
    if (writesStencil && !readsSceneColor) return Drawables::kStencilWriteOrder;
    if (!instance.raster.depthCulling) return Drawables::kNoDepthTestOrder;
    if (readsSceneColor)
        return Drawables::kReadsSceneColorOrder | (instance.raster.depthWrite ? 0 : Drawables::kNoDepthWriteOrder);
    return instance.raster.depthWrite ? 0 : Drawables::kNoDepthWriteOrder;
}

uint32_t orderOf(MaterialInstance const& instance) {
    constexpr uint32_t kMaterialMask = (1u << Drawables::kMaterialBits) - 1;
    constexpr uint32_t kInstanceMask = (1u << Drawables::kInstanceBits) - 1;
    const uint32_t twice = instance.material->hasTwoPasses() ? Drawables::kTwoPassesOrder : 0;
    const uint32_t any = blendsInAnyOrder(instance) ? Drawables::kAnyOrder : 0;
    return depthOrder(instance) | twice | any | (instance.material->id & kMaterialMask) << Drawables::kInstanceBits |
           (instance.id & kInstanceMask);
}

/// Holes of a mask would do no harm, but a package does not tell them from a vertex block.
bool staysInBounds(Drawable const& drawable) {
    shader::MaterialPackage const& package = drawable.material->material->package;
    return drawable.geometry.isOfTriangles && !package.depthReadsParameters &&
           package.vertexDomain == shader::VertexDomain::Object;
}

/// Opaque, undeformed, and drawn whenever it is the nearest: then the depth of its occluder is that of the image.
bool occludes(Drawable const& drawable) {
    InstanceRaster const& raster = drawable.material->raster;
    const bool hasFaces = raster.cullingDisabled || raster.culling != shader::Culling::FrontAndBack;
    return drawable.geometry.occluder && hasFaces && !drawable.deformedAs.isDeformed() && staysInBounds(drawable) &&
           depthOrder(*drawable.material) == 0 && !raster.stencil && !drawable.material->material->isBlended();
}

Drawables::Use useOf(Drawable const& drawable, uint32_t users) {
    return { orderOf(*drawable.material), users, placeOrder(drawable.place), staysInBounds(drawable),
             occludes(drawable) };
}

Drawables::Level levelOf(Drawable const& drawable) {
    const bool isInObjectSpace = drawable.material->material->package.vertexDomain == shader::VertexDomain::Object;
    return { isInObjectSpace ? drawable.coarser : kNoLevel, drawable.errorMeters, drawable.geometry.indexCount / 3 };
}

} // namespace

bool blendsInAnyOrder(MaterialInstance const& instance) {
    InstanceRaster const& raster = instance.raster;
    return shader::blendsInAnyOrder(instance.material->package) && raster.colorWrite && raster.depthCulling &&
           !raster.depthWrite && !raster.stencil;
}

uint32_t GeometryLayouts::intern(GeometryLayout const& layout) {
    for (uint32_t i = 0; i < mLayouts.size(); ++i) {
        if (mLayouts[i] == layout) return i;
    }
    mLayouts.push_back(layout);
    return static_cast<uint32_t>(mLayouts.size() - 1);
}

size_t Drawables::Hash::operator()(Drawable const& drawable) const noexcept {
    Geometry const& geometry = drawable.geometry;
    const uint64_t buffers = static_cast<uint64_t>(geometry.vertices.bits) << 32 | geometry.indices.bits;
    const uint64_t range = static_cast<uint64_t>(geometry.firstIndex) << 32 | geometry.indexCount;
    const uint64_t own = hashCombine(reinterpret_cast<uintptr_t>(drawable.material), drawable.properties.bits());
    const uint64_t kind = uint64_t{ drawable.deformedAs.targets.bits } << 32 | drawable.deformedAs.skin;
    const uint64_t order = hashCombine(kind, placeOrder(drawable.place));
    const uint64_t rest = hashCombine(own, hashCombine(order, drawable.coarser));
    return hashCombine(hashCombine(buffers, range), rest);
}

/// Without memory for it, the coarser levels lose the user that they got.
template <class Acquire>
uint32_t Drawables::acquireAfter(uint32_t coarser, Acquire const& acquire) {
    try {
        return acquire();
    } catch (...) {
        if (coarser != kNoLevel) release(coarser);
        throw;
    }
}

uint32_t Drawables::acquire(Drawable const& drawable) {
    if (drawable.coarser == kNoLevel) return acquireOne(drawable);
    Drawable next = drawable, changed = drawable;
    Drawable const& known = mDrawables[drawable.coarser];
    next.geometry = known.geometry;
    next.errorMeters = known.errorMeters;
    next.coarser = known.coarser;
    changed.coarser = acquire(next);
    return acquireAfter(changed.coarser, [&] { return acquireOne(changed); });
}

uint32_t Drawables::acquire(Drawable const& drawable, std::span<const GeometryLevel> levels) {
    Drawable finest = drawable;
    finest.coarser = kNoLevel;
    // From the coarsest to the finest, because each level names the next coarser one.
    for (; !levels.empty(); levels = levels.first(levels.size() - 1)) {
        GeometryLevel const& coarsest = levels.back();
        Drawable level = finest;
        level.geometry.firstIndex = coarsest.firstIndex;
        level.geometry.indexCount = coarsest.indexCount;
        level.geometry.occluder = coarsest.occluder.get();
        level.errorMeters = coarsest.errorMeters;
        finest.coarser = acquireAfter(finest.coarser, [&] { return acquireOne(level); });
    }
    return acquireAfter(finest.coarser, [&] { return acquireOne(finest); });
}

uint32_t Drawables::acquireOne(Drawable const& drawable) {
    FILAMENT_ASSERT(drawable.material && drawable.material->material, "a renderable needs a material instance");
    const auto [known, isNew] = mNumbers.try_emplace(drawable, limit());
    if (isNew && !mFree.empty()) {
        known->second = mFree.back();
        mFree.pop_back();
    } else if (isNew) {
        mDrawables.emplace_back();
        mUses.emplace_back();
        mLevels.emplace_back();
        mOccluders.emplace_back();
    }
    const uint32_t number = known->second;
    if (isNew) {
        mDrawables[number] = drawable;
        setUse(number, useOf(drawable, 0));
        mLevels[number] = levelOf(drawable);
        // A drawable keeps its occluder alive: the geometry has only a pointer to it.
        if (drawable.geometry.occluder) mOccluders[number] = drawable.geometry.occluder->shared_from_this();
    }
    ++mUses[number].users;
    return number;
}

void Drawables::release(uint32_t number) {
    FILAMENT_ASSERT(number < limit() && mUses[number].users > 0, "a drawable is released once a use");
    const uint32_t coarser = mDrawables[number].coarser;
    if (--mUses[number].users == 0) {
        mNumbers.erase(mDrawables[number]);
        setUse(number, {});
        mOccluders[number].reset();
        mFree.push_back(number);
    }
    if (coarser != kNoLevel) release(coarser);
}

void Drawables::updateUses() {
    for (auto const& [drawable, number] : mNumbers) setUse(number, useOf(drawable, mUses[number].users));
}

void Drawables::setUse(uint32_t number, Use use) {
    mOccluding += static_cast<uint32_t>(use.occludes) - static_cast<uint32_t>(mUses[number].occludes);
    mUses[number] = use;
}

} // namespace filament_core::scene
