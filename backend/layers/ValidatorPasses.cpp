// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/Validator.h"

#include <algorithm>

namespace filament_core::backend {
namespace {

bool covers(DeviceTextureDesc const& desc, uint32_t level, Rect const& area) {
    return static_cast<uint64_t>(area.x) + area.width <= std::max(1u, desc.width >> level) &&
           static_cast<uint64_t>(area.y) + area.height <= std::max(1u, desc.height >> level);
}

uint32_t colorCount(PassLayout const& layout) { return std::min<uint32_t>(layout.colorCount, kMaxColorAttachments); }

} // namespace

// ---------------------------------------------------------------------------------------------- layouts

void Validator::checkPassLayout(PassLayout const& layout) {
    require(layout.colorCount <= std::min(kMaxColorAttachments, mInfo.limits.maxColorAttachments), Harm::Crash,
            "{} colour attachments; this device has {}", layout.colorCount, mInfo.limits.maxColorAttachments);
    require(layout.colorCount > 0 || layout.depthFormat != Format::None, Harm::Crash,
            "a pass without attachments; give it a colour or a depth attachment");
    for (uint32_t i = 0; i < colorCount(layout); ++i) {
        FormatInfo const& format = formatInfo(layout.colorFormats[i]);
        require(layout.colorFormats[i] != Format::None && format.isRenderable && !hasDepth(layout.colorFormats[i]),
                Harm::Crash, "colour {} has format {}, which is no renderable colour format", i, format.name);
        const Format stored = attachmentFormat(layout.colorFormats[i]);
        require(layout.colorFormats[i] == stored, Harm::Crash,
                "colour {} has format {}; passes store its bytes: say attachmentFormat(), which is {}", i, format.name,
                formatInfo(stored).name);
    }
    require(layout.depthFormat == Format::None || hasDepth(layout.depthFormat), Harm::Crash,
            "depth has colour format {}", formatInfo(layout.depthFormat).name);
    require(layout.samples == 1 || layout.samples == 4, Harm::Crash, "{} samples; 1 or 4", layout.samples);
    require(layout.samples > 1 || layout.resolveMask == 0, Harm::Crash,
            "a resolve needs samples > 1; clear resolveMask");
    require((layout.resolveMask >> colorCount(layout)) == 0, Harm::Crash,
            "resolveMask names attachments beyond colorCount");
    require(!layout.resolvesDepth || (layout.samples > 1 && layout.depthFormat != Format::None), Harm::Crash,
            "resolvesDepth needs a depth attachment of samples > 1");
    require(!layout.resolvesDepth || mInfo.features.depthResolve, Harm::Crash,
            "this device lacks DeviceFeatures::depthResolve");
    checkSubpasses(layout);
}

void Validator::checkSubpasses(PassLayout const& layout) {
    const bool counted = require(layout.subpassCount >= 1 && layout.subpassCount <= kMaxSubpasses, Harm::Crash,
                                 "{} subpasses; 1..{}", layout.subpassCount, kMaxSubpasses);
    if (!counted) return;
    require(layout.subpassCount == 1 || layout.samples == 1, Harm::Crash,
            "samples > 1 excludes subpasses; use two passes");
    require(layout.subpassCount == 1 || mInfo.features.mergedPasses, Harm::Crash,
            "this device lacks DeviceFeatures::mergedPasses; use two passes");
    uint32_t written = 0;
    for (uint32_t i = 0; i < layout.subpassCount; ++i) {
        SubpassDesc const& subpass = layout.subpasses[i];
        require((subpass.inputMask & ~written) == 0, Harm::WrongResult,
                "subpass {} reads colours {:#x}; earlier ones wrote only {:#x}", i, subpass.inputMask, written);
        written |= subpass.colorMask & ((1u << colorCount(layout)) - 1);
    }
}

// ---------------------------------------------------------------------------------------------- passes

void Validator::execute(CmdBeginPass const& command) {
    PassDesc const& desc = command.desc;
    enter<CmdBeginPass>(Place::OutsidePasses, desc.debugName);
    checkPassLayout(desc.layout);
    const bool area = require(desc.area.x >= 0 && desc.area.y >= 0 && desc.area.width > 0 && desc.area.height > 0,
                              Harm::Crash, "area {},{} {} x {} is empty or begins outside", desc.area.x, desc.area.y,
                              desc.area.width, desc.area.height);
    if (area) {
        for (uint32_t i = 0; i < colorCount(desc.layout); ++i) checkColorAttachment(desc, i);
        if (desc.layout.depthFormat != Format::None)
            checkDepthAttachment(desc);
        else
            require(!desc.depth.texture, Harm::WrongResult, "a depth texture, but layout.depthFormat is None");
        checkAttachedOnce(desc);
    }
    // Even after an error: the draws of the pass are checked, too, and are not reported as outside of one.
    mPass = OpenPass{ std::string(desc.debugName), desc, 0 };
    mPass->desc.debugName = {};
    mBound = {};
}

Validator::TextureModel const* Validator::checkAttachment(Attachment const& attachment, std::string_view role,
                                                          Rect const& area) {
    TextureModel const* texture = need(mTextures, attachment.texture, role);
    if (!texture) return nullptr;
    DeviceTextureDesc const& desc = texture->desc;
    const uint32_t layers = layersOfLevel(desc, attachment.level);
    const bool exists =
            require(attachment.level < desc.levels && attachment.layer < layers, Harm::Crash,
                    "{} '{}': level {} of {}, {} {} of {}", role, texture->name, attachment.level, desc.levels,
                    desc.type == TextureKind::Texture3D ? "slice" : "layer", attachment.layer, layers);
    if (!exists) return nullptr;
    require(covers(desc, attachment.level, area), Harm::Crash, "{} '{}' is smaller than the area {},{} {} x {}", role,
            texture->name, area.x, area.y, area.width, area.height);
    require(!has(desc.usage, TextureUsage::Transient) ||
                    (attachment.load != LoadOp::Load && attachment.store == StoreOp::Discard),
            Harm::WrongResult, "{} '{}' is transient; clear or discard it, and do not store it", role, texture->name);
    return texture;
}

void Validator::checkColorAttachment(PassDesc const& desc, uint32_t index) {
    const std::string role = fmt::format("colour {}", index);
    TextureModel const* texture = checkAttachment(desc.colors[index], role, desc.area);
    if (!texture) return;
    const Format expected = desc.layout.colorFormats[index];
    require(attachmentFormat(texture->desc.format) == expected, Harm::Crash,
            "{} '{}' has format {}, the layout says {}", role, texture->name, formatInfo(texture->desc.format).name,
            formatInfo(expected).name);
    require(texture->desc.samples == desc.layout.samples, Harm::Crash, "{} '{}' has {} samples, the layout says {}",
            role, texture->name, texture->desc.samples, desc.layout.samples);
    require(has(texture->desc.usage, TextureUsage::ColorAttachment), Harm::Crash,
            "{} '{}' lacks TextureUsage::ColorAttachment", role, texture->name);
    uint32_t inputs = 0;
    for (uint32_t i = 0; i < std::min<uint32_t>(desc.layout.subpassCount, kMaxSubpasses); ++i) {
        inputs |= desc.layout.subpasses[i].inputMask;
    }
    require((inputs >> index & 1) == 0 || has(texture->desc.usage, TextureUsage::InputAttachment), Harm::Crash,
            "{} '{}' is read by a subpass and lacks TextureUsage::InputAttachment", role, texture->name);
    checkResolve(desc, index, texture->desc.format);
}

void Validator::checkResolve(PassDesc const& desc, uint32_t index, Format format) {
    const TextureHandle resolve = desc.colors[index].resolve;
    if ((desc.layout.resolveMask >> index & 1) == 0) {
        require(!resolve, Harm::WrongResult, "colour {} has a resolve target, but resolveMask does not name it", index);
        return;
    }
    TextureModel const* texture = need(mTextures, resolve, fmt::format("resolve target of colour {}", index));
    if (!texture) return;
    require(texture->desc.samples == 1, Harm::Crash, "resolve target '{}' has {} samples", texture->name,
            texture->desc.samples);
    require(texture->desc.format == format, Harm::Crash, "resolve target '{}' has format {}, colour {} has {}",
            texture->name, formatInfo(texture->desc.format).name, index, formatInfo(format).name);
    require(has(texture->desc.usage, TextureUsage::ColorAttachment), Harm::Crash,
            "resolve target '{}' lacks TextureUsage::ColorAttachment", texture->name);
    require(covers(texture->desc, 0, desc.area), Harm::Crash, "resolve target '{}' is smaller than the area",
            texture->name);
}

void Validator::checkDepthAttachment(PassDesc const& desc) {
    TextureModel const* texture = checkAttachment(desc.depth, "depth", desc.area);
    if (!texture) return;
    require(texture->desc.format == desc.layout.depthFormat, Harm::Crash,
            "depth '{}' has format {}, the layout says {}", texture->name, formatInfo(texture->desc.format).name,
            formatInfo(desc.layout.depthFormat).name);
    require(texture->desc.samples == desc.layout.samples, Harm::Crash, "depth '{}' has {} samples, the layout says {}",
            texture->name, texture->desc.samples, desc.layout.samples);
    require(has(texture->desc.usage, TextureUsage::DepthAttachment), Harm::Crash,
            "depth '{}' lacks TextureUsage::DepthAttachment", texture->name);
    checkDepthResolve(desc);
}

void Validator::checkDepthResolve(PassDesc const& desc) {
    const TextureHandle resolve = desc.depth.resolve;
    if (!desc.layout.resolvesDepth) {
        require(!resolve, Harm::WrongResult, "depth has a resolve target, but the layout does not say resolvesDepth");
        return;
    }
    TextureModel const* texture = need(mTextures, resolve, "resolve target of depth");
    if (!texture) return;
    require(texture->desc.samples == 1, Harm::Crash, "resolve target '{}' has {} samples", texture->name,
            texture->desc.samples);
    require(texture->desc.format == desc.layout.depthFormat, Harm::Crash,
            "resolve target '{}' has format {}, depth has {}", texture->name, formatInfo(texture->desc.format).name,
            formatInfo(desc.layout.depthFormat).name);
    require(has(texture->desc.usage, TextureUsage::DepthAttachment), Harm::Crash,
            "resolve target '{}' lacks TextureUsage::DepthAttachment", texture->name);
    require(covers(texture->desc, 0, desc.area), Harm::Crash, "resolve target '{}' is smaller than the area",
            texture->name);
}

void Validator::checkAttachedOnce(PassDesc const& desc) {
    const uint32_t count = colorCount(desc.layout);
    for (uint32_t i = 0; i < count; ++i) {
        Attachment const& a = desc.colors[i];
        for (uint32_t j = i + 1; j < count; ++j) {
            Attachment const& b = desc.colors[j];
            require(a.texture != b.texture || a.level != b.level || a.layer != b.layer, Harm::Crash,
                    "colours {} and {} are the same image", i, j);
            TextureModel const* texture = mTextures.find(a.texture);
            const bool is3D = texture && texture->desc.type == TextureKind::Texture3D;
            require(!is3D || a.texture != b.texture || a.level != b.level || a.layer == b.layer, Harm::Crash,
                    "colours {} and {} are slices of one level of 3D texture '{}'; a pass draws to one of them", i, j,
                    is3D ? texture->name : std::string());
        }
    }
}

void Validator::execute(CmdNextSubpass const&) {
    enter<CmdNextSubpass>(Place::InsidePass);
    if (!mPass) return;
    require(mPass->subpass + 1 < mPass->desc.layout.subpassCount, Harm::Crash, "the pass has only {} subpasses",
            mPass->desc.layout.subpassCount);
    ++mPass->subpass;
    mBound = {};
}

void Validator::execute(CmdEndPass const&) {
    enter<CmdEndPass>(Place::InsidePass);
    if (!mPass) return;
    require(mPass->subpass + 1 == mPass->desc.layout.subpassCount, Harm::Crash,
            "subpass {} of {} is the current one; go through all", mPass->subpass, mPass->desc.layout.subpassCount);
    mPass.reset();
    mBound = {};
}

bool Validator::isAttached(TextureHandle texture, TextureRange const& range) const {
    PassDesc const& desc = mPass->desc;
    const auto touches = [&](Attachment const& at) {
        return (at.texture == texture && overlap(range, { at.level, 1, at.layer, 1 })) ||
               (at.resolve == texture && overlap(range, { 0, 1, 0, 1 }));
    };
    for (uint32_t i = 0; i < colorCount(desc.layout); ++i) {
        if (touches(desc.colors[i])) return true;
    }
    return desc.layout.depthFormat != Format::None && touches(desc.depth);
}

// ---------------------------------------------------------------------------------------------- frames, timers, groups

void Validator::execute(CmdBeginFrame const&) {
    enter<CmdBeginFrame>(Place::OutsidePasses);
    require(!mFrameOpen, Harm::WrongResult, "a frame is open; record CmdEndFrame first");
    mFrameOpen = true;
}

void Validator::execute(CmdEndFrame const&) {
    enter<CmdEndFrame>(Place::OutsidePasses);
    require(mFrameOpen, Harm::WrongResult, "no frame is open; record CmdBeginFrame first");
    mFrameOpen = false;
}

void Validator::execute(CmdBeginTimer const& command) {
    enter<CmdBeginTimer>(Place::OutsidePasses);
    checkTicket(command.ticket);
    mOpenTimers.push_back(command.ticket);
}

void Validator::execute(CmdEndTimer const& command) {
    enter<CmdEndTimer>(Place::OutsidePasses);
    const auto it = std::ranges::find(mOpenTimers, command.ticket);
    if (!require(it != mOpenTimers.end(), Harm::Crash, "timer {} is not open; record CmdBeginTimer first",
                 command.ticket.value))
        return;
    require(it + 1 == mOpenTimers.end(), Harm::Crash, "timer {} began inside of timer {}; end the inner one first",
            mOpenTimers.back().value, command.ticket.value);
    mOpenTimers.erase(it);
}

void Validator::execute(CmdPushGroup const& command) {
    enter<CmdPushGroup>(Place::Anywhere, command.name);
    mOpenGroups.emplace_back(command.name);
}

void Validator::execute(CmdPopGroup const&) {
    enter<CmdPopGroup>(Place::Anywhere);
    if (require(!mOpenGroups.empty(), Harm::WrongResult, "no group is open; record CmdPushGroup first"))
        mOpenGroups.pop_back();
}

} // namespace filament_core::backend
