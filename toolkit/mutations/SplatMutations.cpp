// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareSplats.h"
#include "toolkit/mutations/Edits.h"

#include <algorithm>
#include <span>

namespace filament_core::tools {
namespace {

using prepare::SplatVertex;
using Corners = std::array<SplatVertex, 4>; // of a splat

/// Changes the quads of the splats of a frame.
class SplatEdit : public NamedBufferEdit {
public:
    SplatEdit() : NamedBufferEdit("splats") {}

private:
    void editBuffer(CmdUpdateBuffer& command) final {
        Bytes& bytes = copy(command.bytes);
        std::vector<Corners> splats(bytes.size() / sizeof(Corners));
        std::memcpy(splats.data(), bytes.data(), splats.size() * sizeof(Corners));
        change(splats);
        std::memcpy(bytes.data(), splats.data(), splats.size() * sizeof(Corners));
    }
    virtual void change(std::vector<Corners>& splats) const = 0;
};

class SplatOrderEdit final : public SplatEdit {
    void change(std::vector<Corners>& splats) const override { std::ranges::reverse(splats); }
};

/// The nearest one, by a tenth of its size.
class SplatShiftedEdit final : public SplatEdit {
    void change(std::vector<Corners>& splats) const override {
        const float shift = 0.1f * (splats.back()[1].position.x - splats.back()[0].position.x);
        for (SplatVertex& corner : splats.back()) corner.position.x += shift;
    }
};

/// All end earlier: 3.125 standard deviations are where three should be.
class SplatNarrowEdit final : public SplatEdit {
    void change(std::vector<Corners>& splats) const override {
        for (Corners& splat : splats)
            for (SplatVertex& corner : splat)
                for (uint16_t& at : corner.at) at = static_cast<uint16_t>(at + 0x40);
    }
};

constexpr Mutation kSplatMutations[] = {
    { "splatOrder", "the nearest splats are drawn first", make<SplatOrderEdit> },
    { "splatShifted", "the nearest splat is a tenth of its size beside its place", make<SplatShiftedEdit> },
    { "splatNarrow", "splats fall off 4 % too early", make<SplatNarrowEdit> },
};

} // namespace

std::span<const Mutation> splatMutations() { return kSplatMutations; }

} // namespace filament_core::tools
