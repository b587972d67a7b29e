// SPDX-License-Identifier: Apache-2.0
/// Validator: the rules of backend/api, and a model of the driver's state to check them against.
///   In      streams in sequence.  Out: reports to the sink; whether the stream may reach a driver.
///   Files   ValidatorObjects.cpp (create, destroy), ValidatorContents.cpp (update, upload, blit, read, present),
///           ValidatorPasses.cpp (passes, subpasses, timers, frames), ValidatorDraws.cpp (what a draw needs).
///   Thread  one.
#pragma once

#include "backend/api/Driver.h"
#include "backend/layers/ObjectTable.h"
#include "backend/stream/CommandFields.h"

#include <fmt/core.h>

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace filament_core::backend {

class Validator {
public:
    Validator(DeviceInfo const& info, ResultSink& sink) : mInfo(info), mSink(sink) {}

    /// False: the stream could crash a driver. The model is then unchanged.
    bool check(CommandView commands);

    void execute(CmdCreateBuffer const& command);
    void execute(CmdCreateTexture const& command);
    void execute(CmdCreateSampler const& command);
    void execute(CmdCreateProgram const& command);
    void execute(CmdCreatePipeline const& command);
    void execute(CmdCreateBindGroup const& command);
    void execute(CmdCreateSurface const& command);
    void execute(CmdDestroyBuffer const& command);
    void execute(CmdDestroyTexture const& command);
    void execute(CmdDestroySampler const& command);
    void execute(CmdDestroyProgram const& command);
    void execute(CmdDestroyPipeline const& command);
    void execute(CmdDestroyBindGroup const& command);
    void execute(CmdDestroySurface const& command);

    void execute(CmdUpdateBuffer const& command);
    void execute(CmdUploadTexture const& command);
    void execute(CmdGenerateMips const& command);
    void execute(CmdBlit const& command);
    void execute(CmdReadBuffer const& command);
    void execute(CmdReadTexture const& command);
    void execute(CmdPresent const& command);

    void execute(CmdBeginPass const& command);
    void execute(CmdNextSubpass const& command);
    void execute(CmdEndPass const& command);
    void execute(CmdBeginFrame const& command);
    void execute(CmdEndFrame const& command);
    void execute(CmdBeginTimer const& command);
    void execute(CmdEndTimer const& command);
    void execute(CmdPushGroup const& command);
    void execute(CmdPopGroup const& command);

    void execute(CmdSetViewport const& command);
    void execute(CmdSetScissor const& command);
    void execute(CmdSetStencilReference const& command);
    void execute(CmdBindPipeline const& command);
    void execute(CmdBindGroup const& command);
    void execute(CmdBindVertexBuffers const& command);
    void execute(CmdBindIndexBuffer const& command);
    void execute(CmdDraw const& command);
    void execute(CmdDrawIndexed const& command);
    void execute(CmdDispatch const& command);

private:
    /// The effect of a broken rule in a real driver: a wrong image, or a crash (then the stream is dropped). Bits
    /// that differ between processors count as a crash: they must not reach an image.
    enum class Harm : uint8_t { WrongResult, Crash };
    enum class Place : uint8_t { OutsidePasses, InsidePass, Anywhere };

    /// The descriptions of objects. Names are owned: the stream that carried them is gone.
    struct BufferModel {
        std::string name;
        BufferDesc desc;
    };
    struct TextureModel {
        std::string name;
        DeviceTextureDesc desc;
    };
    struct SamplerModel {
        std::string name;
        SamplerDesc desc;
    };
    struct ProgramModel {
        std::string name;
        ProgramLayout layout;
        bool isCompute = false;
    };
    struct PipelineModel {
        std::string name;
        PipelineDesc desc;
        ProgramLayout layout;
        bool isCompute = false;
    };
    struct BindGroupModel {
        std::string name;
        BindGroupLayout layout;
        std::vector<BindGroupEntry> entries;
    };

    struct SurfaceModel {
        std::string name;
        OutputSpace space = OutputSpace::Srgb;
    };

    /// What is bound inside a pass, for draws, or outside, for dispatches; subpasses and the begin and end of a pass
    /// reset it.
    struct Bound {
        PipelineHandle pipeline;
        std::array<BindGroupHandle, kMaxBindGroups> groups{};
        CmdBindVertexBuffers vertices{};
        CmdBindIndexBuffer indices{};
    };

    struct OpenPass {
        std::string name;
        PassDesc desc;
        uint32_t subpass = 0;
    };

    // ---- reporting
    template <class C>
    void enter(Place place, std::string_view object = {}) {
        mCommand = kFields<C>.name;
        mObject = object;
        mCommandCrashes = false;
        enterPlace(place);
    }
    void enterPlace(Place place);
    /// Reports `rule` unless it holds; returns whether it holds.
    template <class... Args>
    bool require(bool holds, Harm harm, fmt::format_string<Args...> rule, Args&&... args) {
        if (!holds) report(harm, fmt::vformat(rule, fmt::make_format_args(args...)));
        return holds;
    }
    void report(Harm harm, std::string const& rule);

    // ---- objects by handle: report and return null if they are not alive
    template <class Tag, class Object>
    Object const* need(ObjectTable<Tag, Object> const& table, Handle<Tag> handle, std::string_view role);
    template <class C, class Tag, class Object>
    bool mayCreate(ObjectTable<Tag, Object> const& table, C const& command, std::string_view name);
    template <class C, class Tag, class Object>
    void destroy(ObjectTable<Tag, Object>& table, C const& command);

    // ---- rules that several commands share
    bool checkBindGroupLayout(BindGroupLayout const& layout, std::string_view where);
    void checkStages(ProgramDesc const& desc);
    void checkBindingStages(BindingDesc const& binding, bool isCompute, uint32_t group);
    void checkTextureShape(DeviceTextureDesc const& desc);
    void checkTextureUsage(DeviceTextureDesc const& desc);
    void checkVertexLayout(VertexLayout const& layout);
    void checkDrawPipeline(PipelineDesc const& desc, ProgramLayout const& program);
    void checkPipelineState(PipelineDesc const& desc, ProgramLayout const& program);
    void checkEntry(BindingDesc const& binding, BindGroupEntry const& entry);
    void checkUniformEntry(BindGroupEntry const& entry);
    void checkStorageEntry(BindGroupEntry const& entry);
    void checkBufferRange(BindGroupEntry const& entry, BufferModel const& buffer, uint32_t alignment, uint32_t maxBytes,
                          const char* limits);
    void checkTextureEntry(BindingDesc const& binding, BindGroupEntry const& entry);
    void checkEntryRange(BindingDesc const& binding, BindGroupEntry const& entry, TextureModel const& texture);
    bool checkRegion(TextureModel const& texture, std::string_view role, uint32_t level, uint32_t layer,
                     uint32_t layerCount, Rect const& rect);
    bool checkBlitSide(TextureModel const& texture, std::string_view role, TextureUsage usage);
    void checkWrite(Format format, std::string_view what);
    void checkTicket(Ticket ticket);
    void checkPassLayout(PassLayout const& layout);
    void checkSubpasses(PassLayout const& layout);
    void checkColorAttachment(PassDesc const& desc, uint32_t index);
    void checkDepthAttachment(PassDesc const& desc);
    TextureModel const* checkAttachment(Attachment const& attachment, std::string_view role, Rect const& area);
    void checkResolve(PassDesc const& desc, uint32_t index, Format format);
    void checkDepthResolve(PassDesc const& desc);
    void checkAttachedOnce(PassDesc const& desc);

    /// The bound pipeline, if all of its groups are there.
    PipelineModel const* checkBoundState();
    void checkGroup(PipelineModel const& pipeline, uint32_t index);
    void checkGroupTextures(BindGroupModel const& group, uint32_t index);
    void checkVertexRange(PipelineModel const& pipeline, uint64_t lastVertex, uint64_t lastInstance);
    /// Whether the pass attaches any of the range, which has counts.
    bool isAttached(TextureHandle texture, TextureRange const& range) const;

    template <class F>
    void forEachTable(F&& visit);

    DeviceInfo const& mInfo;
    ResultSink& mSink;

    ObjectTable<BufferTag, BufferModel> mBuffers;
    ObjectTable<TextureTag, TextureModel> mTextures;
    ObjectTable<SamplerTag, SamplerModel> mSamplers;
    ObjectTable<ProgramTag, ProgramModel> mPrograms;
    ObjectTable<PipelineTag, PipelineModel> mPipelines;
    ObjectTable<BindGroupTag, BindGroupModel> mBindGroups;
    ObjectTable<SurfaceTag, SurfaceModel> mSurfaces;
    std::unordered_set<Ticket> mUsedTickets;

    std::optional<OpenPass> mPass;
    Bound mBound;
    bool mFrameOpen = false;
    std::vector<Ticket> mOpenTimers;
    std::vector<std::string> mOpenGroups;

    // of the stream being checked
    uint64_t mCommandIndex = 0; // from 1
    const char* mCommand = "";
    std::string_view mObject;
    bool mCrashes = false;        // any command so far
    bool mCommandCrashes = false; // the current one: its object is not added to the model
};

// ---------------------------------------------------------------------------------------------- shared templates

template <class Tag, class Object>
Object const* Validator::need(ObjectTable<Tag, Object> const& table, Handle<Tag> handle, std::string_view role) {
    Object const* object = table.find(handle);
    if (object) return object;
    if (!handle) {
        report(Harm::Crash, fmt::format("the {} is none; give it a handle that was created", role));
    } else if (table.wasDestroyed(handle)) {
        report(Harm::Crash, fmt::format("the {} {:#x} was destroyed; destroy after the last use", role, handle.bits));
    } else {
        report(Harm::Crash, fmt::format("the {} {:#x} does not exist; record its creation first", role, handle.bits));
    }
    return nullptr;
}

} // namespace filament_core::backend
