// SPDX-License-Identifier: Apache-2.0
#include "toolkit/mutations/DefectTrace.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>

namespace filament_core::tools {

using namespace backend;

namespace {

bool isSame(std::span<const std::byte> a, std::span<const std::byte> b) {
    return a.data() == b.data() ? a.size() == b.size() : std::ranges::equal(a, b);
}

bool isSame(ProgramDesc const& a, ProgramDesc const& b) {
    const auto isSameConstant = [](ConstantValue const& x, ConstantValue const& y) {
        return x.id == y.id && x.bits == y.bits;
    };
    return isSame(a.vertex, b.vertex) && isSame(a.fragment, b.fragment) && isSame(a.compute, b.compute) &&
           std::ranges::equal(a.constants, b.constants, isSameConstant);
}

bool isSame(PipelineDesc const& a, PipelineDesc const& b) {
    return a.program == b.program && a.raster == b.raster && a.depthStencil == b.depthStencil && a.blend == b.blend;
}

/// The words that differ are 0; what they were before, if that is 0 itself.
std::vector<std::byte> withZeros(std::span<const std::byte> before, std::span<const std::byte> after) {
    constexpr size_t kWord = 4;
    std::vector<std::byte> words(after.begin(), after.end());
    for (size_t at = 0; at < std::min(before.size(), after.size()); at += kWord) {
        const size_t size = std::min({ kWord, before.size() - at, after.size() - at });
        const std::span<const std::byte> old = before.subspan(at, size);
        const bool wasZero = std::ranges::all_of(old, [](std::byte byte) { return byte == std::byte{}; });
        if (!wasZero && !isSame(old, after.subspan(at, size))) std::memset(words.data() + at, 0, size);
    }
    return words;
}

} // namespace

template <class Handle>
DefectTrace::Object DefectTrace::objectOf(Handle handle) {
    constexpr Kind kind = std::same_as<Handle, BufferHandle>     ? Kind::Buffer
                          : std::same_as<Handle, TextureHandle>  ? Kind::Texture
                          : std::same_as<Handle, SamplerHandle>  ? Kind::Sampler
                          : std::same_as<Handle, ProgramHandle>  ? Kind::Program
                          : std::same_as<Handle, PipelineHandle> ? Kind::Pipeline
                                                                 : Kind::Group;
    return { kind, handle.bits };
}

void DefectTrace::name(Object object, std::string_view kind, std::string_view name) {
    mNames[object] = name.empty() ? std::string(kind) : fmt::format("{} '{}'", kind, name);
}

void DefectTrace::begin() {
    mDrawn.clear();
    mChanged.erase(kPasses);
    mChanged.erase(kViewports);
    mChanged.erase(kDraws);
}

DefectReach DefectTrace::reach() const {
    std::set<Object> changed = mChanged;
    for (auto const& [range, isChanged] : mRanges) {
        if (isChanged) changed.insert(range.first);
    }
    DefectReach reach{ .hasNumbers = mHasNumbers };
    std::set<std::string> names;
    for (Object const& object : changed) {
        const auto known = mNames.find(object);
        names.insert(known != mNames.end() ? known->second
                     : object == kPasses   ? "passes"
                     : object == kDraws    ? "draws"
                                           : "viewports");
        reach.isDrawn = reach.isDrawn || mDrawn.contains(object);
    }
    reach.changed = fmt::format("{}", fmt::join(names, ", "));
    return reach;
}

void DefectTrace::inspect(CommandView commands) {
    mPayloads.clear();
    mDefect->inspect(commands);
    replay(commands, *this);
}

void DefectTrace::changeNumbers(Object object, std::span<const std::byte> before, std::span<const std::byte>& after) {
    const bool isChanged = !isSame(before, after);
    if (isChanged) mHasNumbers = true;
    if (isChanged && object.first == Kind::Texture) change(object);
    if (isChanged && mExaggerated) after = mPayloads.emplace_back(withZeros(before, after));
}

void DefectTrace::edit(CmdCreateTexture& command) {
    const Format format = command.desc.format;
    name(objectOf(command.handle), "texture", command.desc.debugName);
    mDefect->edit(command);
    if (command.desc.format != format) change(objectOf(command.handle));
}

void DefectTrace::edit(CmdCreateSampler& command) {
    const SamplerDesc before = command.desc;
    name(objectOf(command.handle), "sampler", {});
    mDefect->edit(command);
    if (!(command.desc == before)) change(objectOf(command.handle));
}

void DefectTrace::edit(CmdCreateProgram& command) {
    const ProgramDesc before = command.desc;
    name(objectOf(command.handle), "program", command.desc.debugName);
    mDefect->edit(command);
    if (!isSame(before, command.desc)) change(objectOf(command.handle));
}

void DefectTrace::edit(CmdCreatePipeline& command) {
    const PipelineDesc before = command.desc;
    name(objectOf(command.handle), "pipeline", command.desc.debugName);
    mDefect->edit(command);
    if (!isSame(before, command.desc)) change(objectOf(command.handle));
}

void DefectTrace::edit(CmdUploadTexture& command) {
    const std::span<const std::byte> before = command.bytes;
    mDefect->edit(command);
    changeNumbers(objectOf(command.texture), before, command.bytes);
}

void DefectTrace::edit(CmdUpdateBuffer& command) {
    const std::span<const std::byte> before = command.bytes;
    mDefect->edit(command);
    mRanges[{ objectOf(command.buffer), command.offset }] = !isSame(before, command.bytes);
    changeNumbers(objectOf(command.buffer), before, command.bytes);
}

void DefectTrace::edit(CmdBeginPass& command) {
    const PassDesc before = command.desc;
    mDefect->edit(command);
    const bool isSame =
            std::ranges::equal(before.colors, command.desc.colors, {}, &Attachment::layer, &Attachment::layer);
    if (!isSame) changeDrawn(kPasses);
}

void DefectTrace::edit(CmdSetViewport& command) {
    const backend::Viewport before = command.viewport;
    mDefect->edit(command);
    if (command.viewport != before) changeDrawn(kViewports);
}

void DefectTrace::edit(CmdDrawIndexed& command) {
    const uint32_t instances = command.instanceCount, indices = command.indexCount;
    mDefect->edit(command);
    if (command.instanceCount != instances || command.indexCount != indices) changeDrawn(kDraws);
}

void DefectTrace::changeDrawn(Object object) {
    change(object);
    mDrawn.insert(object); // passes set what they draw with
}

void DefectTrace::execute(CmdCreateBuffer const& command) {
    name(objectOf(command.handle), "buffer", command.desc.debugName);
}

void DefectTrace::execute(CmdCreatePipeline const& command) {
    const Object pipeline = objectOf(command.handle);
    mParts[pipeline] = { pipeline, objectOf(command.desc.program) };
}

void DefectTrace::execute(CmdCreateBindGroup const& command) {
    std::vector<Object>& parts = mParts[objectOf(command.handle)];
    parts.clear();
    for (BindGroupEntry const& entry : command.desc.entries) {
        if (entry.buffer) parts.push_back(objectOf(entry.buffer));
        if (entry.texture) parts.push_back(objectOf(entry.texture));
        if (entry.sampler) parts.push_back(objectOf(entry.sampler));
    }
}

void DefectTrace::execute(CmdBindPipeline const& command) { mBound.push_back(objectOf(command.pipeline)); }
void DefectTrace::execute(CmdBindGroup const& command) { mBound.push_back(objectOf(command.group)); }

void DefectTrace::unbind() { mBound.clear(); }

/// What was bound since the last one; the rest was noted then.
void DefectTrace::noteDraw() {
    for (Object const& bound : mBound) {
        const auto parts = mParts.find(bound);
        if (parts == mParts.end())
            mDrawn.insert(bound);
        else
            mDrawn.insert(parts->second.begin(), parts->second.end());
    }
    mBound.clear();
}

} // namespace filament_core::tools
