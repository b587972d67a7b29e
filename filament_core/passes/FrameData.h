// SPDX-License-Identifier: Apache-2.0
/// FrameData: the uniform data of a frame on the device, and the bind group through which shaders see those of a view.
///   In      a FramePacket.   Out: a ViewGroup for each of its views, with offsets into buffers that all views share.
///   Layout  uniforms: an array, a view an element. Objects: windows, those of a view one after the other; then the
///           irradiance fields of the main view (shader::IrradianceField), each of which begins a window. Lights and
///           froxels: storage buffers that hold those of all views, one view after the other; the uniforms of a view
///           say where its own begin (FrameUniforms::froxelPlaces, written here). Behind the froxels of a frame with
///           area lights: shader::kLtcTable; then the light profiles of each view that has some. Before all lights
///           and froxels the images of the lights of the main view, whose tables are uploaded where they are not yet.
///   Memory  three sets of buffers, used in turn, so that no frame overwrites what an earlier one still reads. They
///           grow to the largest frame and stay. Objects are written straight into the memory of the command buffer.
///   Fails   std::bad_alloc; what is recorded then fits what is remembered.
///   Thread  the app thread, with the workers for the objects. Records outside of passes.
#pragma once

#include "backend/stream/CommandStream.h"
#include "filament_core/passes/DeformationBuffer.h"
#include "filament_core/prepare/FramePacket.h"
#include "jobsystem/JobSystem.h"

#include <array>
#include <span>
#include <vector>

namespace filament_core::passes {

/// kGroupView of one view: the group of the frame, and where the view's data begin in the buffers behind it.
struct ViewGroup {
    backend::BindGroupHandle handle;
    uint32_t uniforms = 0, objects = 0;     ///< bytes
    uint32_t firstLight = 0, firstWord = 0; ///< elements of the storage buffers
    uint32_t firstProfileWord = 0;          ///< of the words of profiles; 0: the view has none
    uint32_t fields = 0;                    ///< bytes: where the irradiance fields of the view begin
    ViewGroup const* lists = nullptr;       ///< one for each of ViewPacket::channels, with the same objects

    /// For draws of the window that holds `object` of the view.
    backend::CmdBindGroup bind(uint32_t object) const;
    /// For the draw of one object that has an irradiance field.
    backend::CmdBindGroup bindField(uint32_t field) const;
};

class FrameData {
public:
    explicit FrameData(backend::CommandStream& stream) : mStream(stream) {}

    /// Uploads the packet into the next set and makes its bind group current.
    void upload(jobs::JobSystem& jobs, backend::CommandBuffer& commands, prepare::FramePacket const& packet);
    void destroy(backend::CommandBuffer& commands);

    /// By view of the packet.
    std::span<const ViewGroup> views() const { return mViews; }
    /// Of all views, for dispatches: frame (with the offset of a view), lights and froxels.
    std::array<backend::BindGroupEntry, 3> viewBuffers() const;
    /// By slot of scene::Deformations; those that are not visible are not set.
    std::span<const backend::CmdBindGroup> deformations() const { return mSets[mCurrent].deformation.groups(); }

private:
    /// An array of equal blocks.
    struct Blocks {
        backend::BufferHandle buffer;
        uint32_t capacity = 0;
    };
    /// An image of a light, by its number, and its place in a buffer.
    struct PlacedImage {
        uint32_t number, word;
        friend bool operator==(PlacedImage const&, PlacedImage const&) = default;
    };
    struct Set {
        Blocks uniforms, objects, lights, froxels;
        std::vector<PlacedImage> images; // that lie at the beginning of `froxels`
        backend::BindGroupHandle view;
        DeformationBuffer deformation;
    };
    struct BlockKind {
        uint32_t bytes;
        backend::BufferUsage usage;
        const char* name;
    };
    /// Blocks that a frame needs.
    struct Needs {
        uint32_t views = 0, lights = 0, words = 0, windows = 0;
        uint32_t table = 0;    ///< first word of the table of area lights
        bool hasTable = false; ///< some view has area lights
    };

    void release(backend::CommandBuffer& commands, backend::BindGroupHandle& group);
    void release(backend::CommandBuffer& commands, Blocks& blocks);
    void reserve(backend::CommandBuffer& commands, Set& set, Blocks& blocks, uint32_t count, BlockKind const& kind);
    Needs placeViews(prepare::FramePacket const& packet);
    void bindViews(backend::CommandBuffer& commands, Set& set);
    void uploadView(backend::CommandBuffer& commands, Set const& set, prepare::ViewPacket const& view,
                    ViewGroup const& group, uint32_t table);
    void uploadLights(backend::CommandBuffer& commands, Set const& set, shader::FrameUniforms uniforms,
                      std::span<const shader::PunctualLight> lights, std::span<const uint32_t> froxelWords,
                      ViewGroup const& group);
    void uploadProfiles(backend::CommandBuffer& commands, Set const& set, prepare::ProfileLists const& profiles,
                        uint32_t firstWord);
    void uploadImages(backend::CommandBuffer& commands, Set& set, prepare::LightImageLists const& images);
    void uploadObjects(jobs::JobSystem& jobs, backend::CommandBuffer& commands, Set const& set,
                       prepare::FramePacket const& packet);

    backend::CommandStream& mStream;
    std::array<Set, 3> mSets{};
    uint32_t mCurrent = 0;
    std::vector<ViewGroup> mViews; // of the frame uploaded last
    std::vector<ViewGroup> mLists; // of their channels
    std::vector<PlacedImage> mImages;
};

} // namespace filament_core::passes
