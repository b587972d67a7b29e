// SPDX-License-Identifier: Apache-2.0
/// ObjectHandles: the handles of one type that one engine or one scene gives out.
///   Fails   refuse() ends the process and says whether the handle is null, of another owner, or of something that is
///           gone: apps break these rules, files do not.
///   Thread  as HandleAllocator.
#pragma once

#include "base/Handle.h"

#include <filament_core/Objects.h>

#include <string_view>

namespace filament_core::scene {

/// Unlike any other in the process, and never 0: of an engine or a scene.
uint64_t newOwnerSerial();
/// What handles say of the owner; never 0. 65535 owners later it is the same again.
constexpr uint16_t ownerTag(uint64_t serial) { return static_cast<uint16_t>(serial % 0xFFFF + 1); }

/// What messages call the objects of a type.
struct ObjectKind {
    const char* name;
    bool isOfScene; ///< added to a scene and removed from it; otherwise created by an engine and destroyed
};
template <class Tag>
inline constexpr ObjectKind kObjectKind{ "object", false };
template <>
inline constexpr ObjectKind kObjectKind<TextureObject>{ "texture", false };
template <>
inline constexpr ObjectKind kObjectKind<VertexBufferObject>{ "vertex buffer", false };
template <>
inline constexpr ObjectKind kObjectKind<IndexBufferObject>{ "index buffer", false };
template <>
inline constexpr ObjectKind kObjectKind<MaterialObject>{ "material", false };
template <>
inline constexpr ObjectKind kObjectKind<MaterialInstanceObject>{ "material instance", false };
template <>
inline constexpr ObjectKind kObjectKind<IndirectLightObject>{ "indirect light", false };
template <>
inline constexpr ObjectKind kObjectKind<MorphTargetsObject>{ "morph targets", false };
template <>
inline constexpr ObjectKind kObjectKind<LightProfileObject>{ "light profile", false };
template <>
inline constexpr ObjectKind kObjectKind<LightImageObject>{ "light image", false };
template <>
inline constexpr ObjectKind kObjectKind<SkyboxObject>{ "skybox", false };
template <>
inline constexpr ObjectKind kObjectKind<RenderTargetObject>{ "render target", false };
template <>
inline constexpr ObjectKind kObjectKind<SwapChainObject>{ "swap chain", false };
template <>
inline constexpr ObjectKind kObjectKind<RenderableObject>{ "renderable", true };
template <>
inline constexpr ObjectKind kObjectKind<LightObject>{ "light", true };
template <>
inline constexpr ObjectKind kObjectKind<SkinObject>{ "skin", true };
template <>
inline constexpr ObjectKind kObjectKind<NodeObject>{ "node", true };

enum class HandleFault : uint8_t { Null, OfAnother, Gone };

/// `name`: of what is gone, if it is known.
[[noreturn]] void refuseHandle(ObjectKind kind, HandleFault fault, std::string_view name);

template <class Tag>
class ObjectHandles {
public:
    explicit ObjectHandles(uint16_t owner = 0) : mOwner(owner) {}

    ObjectHandle<Tag> allocate() {
        const ObjectHandle<Tag> given = mAllocator.allocate();
        return ObjectHandle<Tag>::make(given.index(), given.generation(), mOwner);
    }
    void free(ObjectHandle<Tag> handle) { mAllocator.free(handle); }
    bool isLive(ObjectHandle<Tag> handle) const { return handle.owner() == mOwner && mAllocator.isLive(handle); }

    /// Of a handle that is not live.
    [[noreturn]] void refuse(ObjectHandle<Tag> handle, std::string_view name = {}) const {
        const HandleFault fault = !handle                    ? HandleFault::Null
                                  : handle.owner() != mOwner ? HandleFault::OfAnother
                                                             : HandleFault::Gone;
        refuseHandle(kObjectKind<Tag>, fault, name);
    }

private:
    HandleAllocator<Tag, ObjectHandle> mAllocator;
    uint16_t mOwner;
};

} // namespace filament_core::scene
