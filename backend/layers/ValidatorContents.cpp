// SPDX-License-Identifier: Apache-2.0
#include "backend/layers/Validator.h"

#include <algorithm>

namespace filament_core::backend {
namespace {

uint32_t levelSize(uint32_t size, uint32_t level) { return std::max(1u, size >> level); }

bool inside(Rect const& rect, uint32_t width, uint32_t height) {
    return rect.x >= 0 && rect.y >= 0 && rect.width > 0 && rect.height > 0 &&
           static_cast<uint64_t>(rect.x) + rect.width <= width && static_cast<uint64_t>(rect.y) + rect.height <= height;
}

bool overlap(Rect const& a, Rect const& b) {
    return a.x < b.x + static_cast<int64_t>(b.width) && b.x < a.x + static_cast<int64_t>(a.width) &&
           a.y < b.y + static_cast<int64_t>(b.height) && b.y < a.y + static_cast<int64_t>(a.height);
}

// Compressed images are addressed in whole blocks; a block at the edge may be partial.
bool onBlocks(Rect const& rect, uint32_t width, uint32_t height, uint32_t block) {
    const auto x = static_cast<uint32_t>(rect.x), y = static_cast<uint32_t>(rect.y);
    return x % block == 0 && y % block == 0 && (rect.width % block == 0 || x + rect.width == width) &&
           (rect.height % block == 0 || y + rect.height == height);
}

} // namespace

void Validator::execute(CmdUpdateBuffer const& command) {
    enter<CmdUpdateBuffer>(Place::OutsidePasses);
    BufferModel const* buffer = need(mBuffers, command.buffer, "buffer");
    if (!buffer) return;
    mObject = buffer->name;
    const uint64_t size = buffer->desc.size;
    require(command.offset <= size && command.bytes.size() <= size - command.offset, Harm::Crash,
            "bytes {}..{} of a buffer of {}", command.offset, command.offset + command.bytes.size(), size);
}

bool Validator::checkRegion(TextureModel const& texture, std::string_view role, uint32_t level, uint32_t layer,
                            uint32_t layerCount, Rect const& rect) {
    DeviceTextureDesc const& desc = texture.desc;
    const bool exists = require(level < desc.levels, Harm::Crash, "{} '{}': level {} of {}", role, texture.name, level,
                                desc.levels) &&
                        require(layerCount > 0 && layer + layerCount <= layersOfLevel(desc, level), Harm::Crash,
                                "{} '{}': layers {}..{} of {}", role, texture.name, layer, layer + layerCount,
                                layersOfLevel(desc, level));
    if (!exists) return false;
    const uint32_t width = levelSize(desc.width, level), height = levelSize(desc.height, level);
    return require(inside(rect, width, height), Harm::Crash,
                   "{} '{}': rectangle {},{} {} x {} is empty or leaves level {} of {} x {}", role, texture.name,
                   rect.x, rect.y, rect.width, rect.height, level, width, height);
}

void Validator::execute(CmdUploadTexture const& command) {
    enter<CmdUploadTexture>(Place::OutsidePasses);
    TextureModel const* texture = need(mTextures, command.texture, "texture");
    if (!texture) return;
    mObject = texture->name;
    DeviceTextureDesc const& desc = texture->desc;
    require(has(desc.usage, TextureUsage::TransferTarget), Harm::Crash,
            "the texture lacks TextureUsage::TransferTarget");
    require(!hasStencil(desc.format), Harm::Crash, "depth and stencil together cannot be uploaded; draw them");
    if (!checkRegion(*texture, "texture", command.level, command.layer, command.layerCount, command.rect)) return;
    const uint32_t width = levelSize(desc.width, command.level), height = levelSize(desc.height, command.level);
    FormatInfo const& format = formatInfo(desc.format);
    require(onBlocks(command.rect, width, height, format.blockSize), Harm::Crash,
            "rectangle {},{} {} x {} cuts through {}x{} blocks of {}", command.rect.x, command.rect.y,
            command.rect.width, command.rect.height, format.blockSize, format.blockSize, format.name);
    const uint64_t expected = imageBytes(desc.format, command.rect.width, command.rect.height) * command.layerCount;
    require(command.bytes.size() == expected, Harm::Crash, "{} bytes for {} x {} x {} texels of {}; that is {}",
            command.bytes.size(), command.rect.width, command.rect.height, command.layerCount, format.name, expected);
}

void Validator::execute(CmdGenerateMips const& command) {
    enter<CmdGenerateMips>(Place::OutsidePasses);
    TextureModel const* texture = need(mTextures, command.texture, "texture");
    if (!texture) return;
    mObject = texture->name;
    FormatInfo const& format = formatInfo(texture->desc.format);
    require(has(texture->desc.usage, TextureUsage::TransferSource) &&
                    has(texture->desc.usage, TextureUsage::TransferTarget),
            Harm::Crash, "generating mips needs TransferSource and TransferTarget");
    require(texture->desc.type != TextureKind::Texture3D, Harm::Crash,
            "mips of a 3D texture cannot be generated; upload them");
    require(format.kind == FormatKind::Color && format.isRenderable, Harm::Crash,
            "mips of {} cannot be generated; upload them", format.name);
    checkWrite(texture->desc.format, "generating mips");
}

void Validator::checkWrite(Format format, std::string_view what) {
    require(isWritable(format) || !formatInfo(format).isRenderable, Harm::Crash,
            "{} would let the driver encode {}, which has other bits on other processors; encode in a shader or on the "
            "CPU, write a format without Srgb or upload the texels",
            what, formatInfo(format).name);
}

bool Validator::checkBlitSide(TextureModel const& texture, std::string_view role, TextureUsage usage) {
    FormatInfo const& format = formatInfo(texture.desc.format);
    return require(has(texture.desc.usage, usage), Harm::Crash, "{} '{}' lacks TextureUsage::Transfer{}", role,
                   texture.name, usage == TextureUsage::TransferSource ? "Source" : "Target") &
           require(texture.desc.type != TextureKind::Texture3D, Harm::Crash,
                   "{} '{}' is a 3D texture, which cannot be blitted; upload its texels", role, texture.name) &
           require(texture.desc.samples == 1, Harm::Crash, "{} '{}' has {} samples; resolve it in a pass", role,
                   texture.name, texture.desc.samples) &
           require(format.kind <= FormatKind::UnsignedInteger && format.isRenderable, Harm::Crash,
                   "{} '{}': {} cannot be blitted; only renderable colour formats can", role, texture.name,
                   format.name);
}

void Validator::execute(CmdBlit const& command) {
    enter<CmdBlit>(Place::OutsidePasses);
    TextureModel const* source = need(mTextures, command.source, "source");
    TextureModel const* target = need(mTextures, command.target, "target");
    if (!source || !target) return;
    mObject = target->name;
    if (!checkBlitSide(*source, "source", TextureUsage::TransferSource)) return;
    if (!checkBlitSide(*target, "target", TextureUsage::TransferTarget)) return;
    checkWrite(target->desc.format, fmt::format("a blit to '{}'", target->name));
    checkRegion(*source, "source", command.sourceLevel, command.sourceLayer, 1, command.sourceRect);
    checkRegion(*target, "target", command.targetLevel, command.targetLayer, 1, command.targetRect);
    const FormatKind from = formatInfo(source->desc.format).kind, to = formatInfo(target->desc.format).kind;
    require(from == to, Harm::Crash, "integer and other formats do not mix in a blit");
    require(from != FormatKind::UnsignedInteger || command.filter == Filter::Nearest, Harm::Crash,
            "integer textures cannot be filtered; use Nearest");
    const bool sameImage = command.source == command.target && command.sourceLevel == command.targetLevel &&
                           command.sourceLayer == command.targetLayer;
    require(!sameImage || !overlap(command.sourceRect, command.targetRect), Harm::WrongResult,
            "source and target overlap; blit over a third texture");
}

void Validator::execute(CmdReadBuffer const& command) {
    enter<CmdReadBuffer>(Place::OutsidePasses);
    checkTicket(command.ticket);
    BufferModel const* buffer = need(mBuffers, command.buffer, "buffer");
    if (!buffer) return;
    mObject = buffer->name;
    require(has(buffer->desc.usage, BufferUsage::TransferSource), Harm::Crash,
            "the buffer lacks BufferUsage::TransferSource");
    const uint64_t size = buffer->desc.size;
    require(command.size > 0 && command.offset <= size && command.size <= size - command.offset, Harm::Crash,
            "bytes {}..{} of a buffer of {}", command.offset, command.offset + command.size, size);
}

void Validator::execute(CmdReadTexture const& command) {
    enter<CmdReadTexture>(Place::OutsidePasses);
    checkTicket(command.ticket);
    TextureModel const* texture = need(mTextures, command.texture, "texture");
    if (!texture) return;
    mObject = texture->name;
    FormatInfo const& format = formatInfo(texture->desc.format);
    require(has(texture->desc.usage, TextureUsage::TransferSource), Harm::Crash,
            "the texture lacks TextureUsage::TransferSource");
    require(texture->desc.samples == 1, Harm::Crash, "{} samples; resolve before reading back", texture->desc.samples);
    require(format.isRenderable, Harm::Crash, "{} cannot be read back; draw it into a renderable format", format.name);
    checkRegion(*texture, "texture", command.level, command.layer, 1, command.rect);
}

void Validator::checkTicket(Ticket ticket) {
    if (!require(static_cast<bool>(ticket), Harm::WrongResult,
                 "the ticket is none; take one from CommandStream::nextTicket()")) {
        return;
    }
    require(mUsedTickets.insert(ticket).second, Harm::WrongResult, "ticket {} was used before; each names one answer",
            ticket.value);
}

void Validator::execute(CmdPresent const& command) {
    enter<CmdPresent>(Place::OutsidePasses);
    SurfaceModel const* surface = need(mSurfaces, command.surface, "surface");
    TextureModel const* texture = need(mTextures, command.texture, "texture");
    if (!surface || !texture) return;
    mObject = surface->name;
    if (!checkBlitSide(*texture, "texture", TextureUsage::TransferSource)) return;
    const Format format = texture->desc.format;
    const bool isScRgb = format == Format::RGBA16F && surface->space == OutputSpace::LinearRec709;
    require(format == Format::RGBA8 || format == Format::RGB10A2 || isScRgb, Harm::WrongResult,
            "texture '{}' is {}; a window shows RGBA8 or RGB10A2", texture->name, formatInfo(format).name);
}

} // namespace filament_core::backend
