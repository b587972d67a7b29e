// SPDX-License-Identifier: Apache-2.0
/// DefectTrace: a defect on its way into a command stream, and how far it comes: which objects it changes, and whether
/// a draw has them. A defect that no draw reads proves nothing, whatever its image.
///   In      the defect. `exaggerated`: where it changes numbers or texels there are zeros, so that whatever reads them
///           must show it.
///   Out     reach(), of everything since begin().
///   Limits  which objects a draw has, not which of their numbers its code reads: that only the image of the
///           exaggerated defect tells. States, programs and samplers are as gross as they can be.
///   Thread  that of a StreamEdit: the driver's. begin() and reach(): any, while the device is idle.
///   Memory  a name an object, a number for each that is bound or changed.   Fails: never.
///   Cost    a look-up for each object of each draw.
#pragma once

#include "backend/layers/Captured.h"

#include <array>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::tools {

struct DefectReach {
    std::string changed;     ///< "buffer 'frame', buffer 'lights'"; empty: no command
    bool isDrawn = false;    ///< a draw has something of that
    bool hasNumbers = false; ///< numbers or texels are among it, which can be exaggerated
};

class DefectTrace final : public backend::StreamEdit {
public:
    explicit DefectTrace(std::unique_ptr<backend::StreamEdit> defect, bool exaggerated = false)
            : mDefect(std::move(defect)), mExaggerated(exaggerated) {}

    /// Forgets what was drawn. What is changed already, such as the textures of a model that is kept, stays so.
    void begin();
    DefectReach reach() const;

    void inspect(backend::CommandView commands) override;
    void edit(backend::CmdCreateTexture& command) override;
    void edit(backend::CmdCreateSampler& command) override;
    void edit(backend::CmdCreateProgram& command) override;
    void edit(backend::CmdCreatePipeline& command) override;
    void edit(backend::CmdUploadTexture& command) override;
    void edit(backend::CmdUpdateBuffer& command) override;
    void edit(backend::CmdBeginPass& command) override;
    void edit(backend::CmdSetViewport& command) override;
    void edit(backend::CmdDrawIndexed& command) override;

    // For replay(): what draws have.
    template <class C>
    void execute(C const&) {}
    void execute(backend::CmdCreateBuffer const& command);
    void execute(backend::CmdCreatePipeline const& command);
    void execute(backend::CmdCreateBindGroup const& command);
    void execute(backend::CmdBeginPass const&) { unbind(); }
    void execute(backend::CmdNextSubpass const&) { unbind(); }
    void execute(backend::CmdEndPass const&) { unbind(); }
    void execute(backend::CmdBindPipeline const& command);
    void execute(backend::CmdBindGroup const& command);
    void execute(backend::CmdDraw const&) { noteDraw(); }
    void execute(backend::CmdDrawIndexed const&) { noteDraw(); }
    void execute(backend::CmdDispatch const&) { noteDraw(); }

private:
    enum class Kind : uint8_t { Buffer, Texture, Sampler, Program, Pipeline, Group, Pass, Viewport, Draw };
    using Object = std::pair<Kind, uint64_t>; // and the bits of its handle
    static constexpr Object kPasses{ Kind::Pass, 0 }, kViewports{ Kind::Viewport, 0 }, kDraws{ Kind::Draw, 0 };

    template <class Handle>
    static Object objectOf(Handle handle);
    void name(Object object, std::string_view kind, std::string_view name);
    void change(Object object) { mChanged.insert(object); }
    void changeDrawn(Object object); ///< of commands that name no object
    void changeNumbers(Object object, std::span<const std::byte> before, std::span<const std::byte>& after);
    void unbind();
    void noteDraw();

    const std::unique_ptr<backend::StreamEdit> mDefect;
    const bool mExaggerated;
    std::deque<std::vector<std::byte>> mPayloads; // exaggerated, until the next stream; grows without moving elements
    std::map<Object, std::string> mNames;
    std::map<Object, std::vector<Object>> mParts; // objects of bind groups; programs of pipelines
    std::set<Object> mChanged, mDrawn;
    bool mHasNumbers = false;
    std::map<std::pair<Object, uint64_t>, bool> mRanges; // of buffers, by where updates begin: the last one was changed
    std::vector<Object> mBound;
};

} // namespace filament_core::tools
