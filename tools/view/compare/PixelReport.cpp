// SPDX-License-Identifier: Apache-2.0
#include "tools/view/compare/PixelReport.h"

#include "backend/api/Format.h"
#include "toolkit/pictures/Pixels.h"

#include <filament_core/Color.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <span>
#include <type_traits>

namespace filament_core::view {
namespace {

using backend::CapturedAttachment;
using backend::CapturedPass;

constexpr const char* kNothing = "-";

std::span<const std::byte> texelBytes(Format format, uint32_t width, std::span<const std::byte> pixels, uint2 at) {
    const size_t size = backend::formatInfo(format).bytesPerBlock;
    const size_t begin = (size_t{ at.y } * width + at.x) * size;
    return begin + size <= pixels.size() ? pixels.subspan(begin, size) : std::span<const std::byte>{};
}

std::string numbersText(Format format, std::span<const std::byte> texel) {
    const std::array<float, 4> value = tools::texel(format, texel, 0);
    std::string text;
    for (uint32_t c = 0; c < std::max<uint32_t>(1, backend::formatInfo(format).components); ++c)
        text += fmt::format("{}{:.6g}", c > 0 ? ", " : "", value[c]);
    return text;
}

/// Codes from 0 to 255 as they are; what is packed, as a word.
std::string textOf(Format format, std::span<const std::byte> texel) {
    if (texel.empty()) return kNothing;
    const backend::FormatInfo info = backend::formatInfo(format);
    if (info.isFloat || format == Format::R11G11B10F || format == Format::D32F) return numbersText(format, texel);
    std::string text;
    if (info.bytesPerBlock == info.components) {
        for (const std::byte code : texel)
            text += fmt::format("{}{}", text.empty() ? "" : ", ", static_cast<int>(code));
        return text;
    }
    for (size_t i = texel.size(); i-- > 0;) text += fmt::format("{:02x}", static_cast<int>(texel[i]));
    return "0x" + text;
}

void addRow(std::vector<PixelRow>& rows, std::string group, std::string name, std::string detail, std::string own,
            std::string other) {
    const bool differs = own != other;
    rows.push_back(
            { std::move(group), std::move(name), std::move(detail), { std::move(own), std::move(other) }, differs });
}

// ---- the picture and what is seen in it

std::string displayedText(InspectedFrame const* frame, uint2 pixel) {
    if (!frame || frame->picture.pixels.empty()) return kNothing;
    Image const& picture = frame->picture;
    return textOf(picture.format, texelBytes(picture.format, picture.width, picture.pixels, pixel));
}

/// DebugView::Normals shows (n + 1) / 2 as codes of sRGB (docs/debug-views.md); targets of light hold their light.
std::string normalText(InspectedFrame const* frame, uint2 pixel) {
    if (!frame || frame->normals.format != Format::RGBA16F) return kNothing;
    const auto bytes = texelBytes(Format::RGBA16F, frame->normals.width, frame->normals.pixels, pixel);
    if (bytes.empty() || (frame->surface && frame->surface->object.empty())) return kNothing;
    const std::array<float, 4> light = tools::texel(Format::RGBA16F, bytes, 0);
    const float3 normal = color::srgbFromLinear({ light[0], light[1], light[2] }) * 2.0f - 1.0f;
    return fmt::format("{:.3f}, {:.3f}, {:.3f}", normal.x, normal.y, normal.z);
}

template <class Text>
std::string surfaceText(InspectedFrame const* frame, Text const& text) {
    return frame && frame->surface && !frame->surface->object.empty() ? text(*frame->surface) : kNothing;
}

void addPictureRows(std::vector<PixelRow>& rows, uint2 pixel, InspectedFrame const* own, InspectedFrame const* other) {
    const auto add = [&](const char* name, const char* detail, auto const& textOfFrame) {
        addRow(rows, "picture", name, detail, textOfFrame(own), textOfFrame(other));
    };
    add("displayed", "0 to 255", [&](InspectedFrame const* frame) { return displayedText(frame, pixel); });
    add("object", "", [](InspectedFrame const* frame) {
        return surfaceText(frame, [](PixelSurface const& surface) { return surface.object; });
    });
    add("depth", "m, along the view", [](InspectedFrame const* frame) {
        return surfaceText(frame,
                           [](PixelSurface const& surface) { return fmt::format("{:.7g}", surface.distanceMeters); });
    });
    add("position", "m, in the world", [](InspectedFrame const* frame) {
        return surfaceText(frame, [](PixelSurface const& surface) {
            double3 const& p = surface.positionWorld;
            return fmt::format("{:.7g}, {:.7g}, {:.7g}", p.x, p.y, p.z);
        });
    });
    add("normal", "in the world", [&](InspectedFrame const* frame) { return normalText(frame, pixel); });
}

// ---- why it has its light

template <class Text>
std::string explainedText(InspectedFrame const* frame, Text const& text) {
    return frame && frame->explanation ? text(*frame->explanation) : kNothing;
}

std::string lightText(double4 const& light) { return fmt::format("{:.6g}, {:.6g}, {:.6g}", light.x, light.y, light.z); }

template <class Number>
std::string textOf(std::optional<Number> const& value) {
    if (!value) return kNothing;
    if constexpr (std::is_same_v<Number, float3>)
        return fmt::format("{:.6g}, {:.6g}, {:.6g}", value->x, value->y, value->z);
    else if constexpr (std::is_same_v<Number, float>)
        return fmt::format("{:.6g}", *value);
    else
        return fmt::to_string(*value);
}

/// The terms of the first frame that has some: of one document both have the same.
void addTerms(std::vector<PixelRow>& rows, PixelExplanation const& first, InspectedFrame const* own,
              InspectedFrame const* other) {
    constexpr const char* kGroup = "light, before the tone mapper";
    const auto add = [&](std::string const& name, const char* detail, auto const& valueOf) {
        const auto text = [&](PixelExplanation const& explanation) { return lightText(valueOf(explanation)); };
        addRow(rows, kGroup, name, detail, explainedText(own, text), explainedText(other, text));
    };
    for (size_t i = 0; i < first.terms.size(); ++i) {
        add(first.terms[i].term.name, toString(first.terms[i].term.kind),
            [&](PixelExplanation const& of) { return i < of.terms.size() ? of.terms[i].value : double4(0); });
    }
    add("sum", "of these terms", [](PixelExplanation const& of) { return of.value; });
}

void addSurface(std::vector<PixelRow>& rows, InspectedFrame const* own, InspectedFrame const* other) {
    using Surface = filament_core::PixelSurface;
    const auto add = [&](const char* name, const char* detail, auto const& valueOf) {
        const auto text = [&](PixelExplanation const& explanation) {
            return explanation.surface ? valueOf(*explanation.surface) : std::string(kNothing);
        };
        addRow(rows, "surface", name, detail, explainedText(own, text), explainedText(other, text));
    };
    add("material", "its instance, and its file", [](Surface const& of) { return of.instance + ", " + of.material; });
    add("base colour", "linear", [](Surface const& of) { return textOf(of.baseColor); });
    add("roughness", "perceptual", [](Surface const& of) { return textOf(of.roughness); });
    add("metallic", "", [](Surface const& of) { return textOf(of.metallic); });
    add("occlusion", "of the material", [](Surface const& of) { return textOf(of.occlusion); });
    add("emissive", "pre-exposed", [](Surface const& of) { return textOf(of.emissive); });
    add("object id", "docs/aovs.md", [](Surface const& of) { return textOf(of.objectId); });
    add("material id", "docs/aovs.md", [](Surface const& of) { return textOf(of.materialId); });
    add("instance id", "docs/aovs.md", [](Surface const& of) { return textOf(of.materialInstanceId); });
    add("triangle id", "docs/aovs.md", [](Surface const& of) { return textOf(of.triangleId); });
}

void addLobes(std::vector<PixelRow>& rows, PixelExplanation const& first, InspectedFrame const* own,
              InspectedFrame const* other) {
    for (size_t i = 0; i < first.lobes.size(); ++i) {
        const auto text = [&](PixelExplanation const& of) {
            return i < of.lobes.size() ? lightText(of.lobes[i].value) : std::string(kNothing);
        };
        addRow(rows, "the same light, by lobe", first.lobes[i].name, "of the surface's material",
               explainedText(own, text), explainedText(other, text));
    }
}

void addTextures(std::vector<PixelRow>& rows, PixelExplanation const& first, InspectedFrame const* own,
                 InspectedFrame const* other) {
    for (size_t i = 0; i < first.textures.size(); ++i) {
        PixelTexture const& texture = first.textures[i];
        const auto text = [&](PixelExplanation const& of) {
            return i < of.textures.size() ? lightText(of.textures[i].value) : std::string(kNothing);
        };
        const bool isTexture = !texture.parameter.empty();
        addRow(rows, "the same light, by texture", isTexture ? texture.parameter : "none",
               isTexture ? fmt::format("{} {}x{}", texture.texture, texture.size.x, texture.size.y)
                         : std::string("without any of these"),
               explainedText(own, text), explainedText(other, text));
    }
}

void addTexels(std::vector<PixelRow>& rows, PixelExplanation const& first, InspectedFrame const* own,
               InspectedFrame const* other) {
    for (size_t i = 0; i < first.textures.size(); ++i) {
        PixelTexture const& texture = first.textures[i];
        if (!texture.texel) continue;
        const auto text = [&](PixelExplanation const& of) {
            return i < of.textures.size() ? textOf(of.textures[i].texel) : std::string(kNothing);
        };
        addRow(rows, "texels, linear", texture.parameter,
               texture.uv ? fmt::format("at {:.6g}, {:.6g}", texture.uv->x, texture.uv->y) : "of the second set",
               explainedText(own, text), explainedText(other, text));
    }
}

void addExplanation(std::vector<PixelRow>& rows, InspectedFrame const* own, InspectedFrame const* other) {
    InspectedFrame const* const first = own && own->explanation ? own : other;
    if (!first || !first->explanation) return;
    addTerms(rows, *first->explanation, own, other);
    addLobes(rows, *first->explanation, own, other);
    addTextures(rows, *first->explanation, own, other);
    addSurface(rows, own, other);
    addTexels(rows, *first->explanation, own, other);
}

// ---- attachments

uint2 sizeOf(CapturedAttachment const& attachment) { return { attachment.width, attachment.height }; }

/// The same attachment of the other frame, if that has the same passes.
CapturedAttachment const* counterpart(InspectedFrame const* frame, size_t pass, size_t attachment,
                                      CapturedPass const& same) {
    if (!frame || pass >= frame->inside.passes.size()) return nullptr;
    CapturedPass const& found = frame->inside.passes[pass];
    if (found.name != same.name || attachment >= found.attachments.size()) return nullptr;
    return &found.attachments[attachment];
}

struct TexelText {
    std::string text = kNothing;
    std::vector<std::byte> bits{};
};

TexelText texelText(CapturedAttachment const* attachment, uint2 texel) {
    if (!attachment || texel.x >= attachment->width || texel.y >= attachment->height) return {};
    const auto bytes = texelBytes(attachment->format, attachment->width, attachment->bytes, texel);
    return { textOf(attachment->format, bytes), { bytes.begin(), bytes.end() } };
}

PixelRow attachmentRow(CapturedPass const& pass, CapturedAttachment const& attachment, uint2 texel, uint2 view,
                       std::array<TexelText, 2> const& texts) {
    const uint2 size = sizeOf(attachment);
    std::string detail = fmt::format("{} {}x{}", backend::formatInfo(attachment.format).name, size.x, size.y);
    if (size != view) detail += fmt::format(" at {}, {}", texel.x, texel.y);
    return { .group = pass.name,
             .name = attachment.name,
             .detail = std::move(detail),
             .values = { texts[0].text, texts[1].text },
             .differs = texts[0].bits != texts[1].bits };
}

void addAttachments(std::vector<PixelRow>& rows, uint2 pixel, InspectedFrame const& first, InspectedFrame const* own,
                    InspectedFrame const* other) {
    for (size_t p = 0; p < first.inside.passes.size(); ++p) {
        CapturedPass const& pass = first.inside.passes[p];
        for (size_t a = 0; a < pass.attachments.size(); ++a) {
            CapturedAttachment const& attachment = pass.attachments[a];
            const std::optional<uint2> texel = texelOf(pixel, first.size, sizeOf(attachment));
            if (!texel) continue;
            const std::array<TexelText, 2> texts{ texelText(counterpart(own, p, a, pass), *texel),
                                                  texelText(counterpart(other, p, a, pass), *texel) };
            rows.push_back(attachmentRow(pass, attachment, *texel, first.size, texts));
        }
    }
}

} // namespace

std::optional<uint2> texelOf(uint2 pixel, uint2 view, uint2 attachment) {
    if (attachment.x == 0 || attachment.y == 0) return std::nullopt;
    for (uint32_t level = 0; level < 16; ++level) {
        const auto isLevel = [&](uint32_t side, uint32_t whole) {
            const uint32_t down = std::max(1u, whole >> level), up = (whole + (1u << level) - 1) >> level;
            return side == down || side == up;
        };
        if (!isLevel(attachment.x, view.x) || !isLevel(attachment.y, view.y)) continue;
        return min(uint2(pixel.x >> level, pixel.y >> level), attachment - 1u);
    }
    return std::nullopt;
}

std::vector<PixelRow> pixelRows(uint2 pixel, InspectedFrame const* own, InspectedFrame const* other) {
    std::vector<PixelRow> rows;
    if (!own && !other) return rows;
    addPictureRows(rows, pixel, own, other);
    addExplanation(rows, own, other);
    addAttachments(rows, pixel, own ? *own : *other, own, other);
    return rows;
}

uint32_t unseenAttachments(InspectedFrame const* own, InspectedFrame const* other) {
    InspectedFrame const* first = own ? own : other;
    uint32_t unseen = 0;
    if (!first) return unseen;
    for (CapturedPass const& pass : first->inside.passes)
        for (CapturedAttachment const& attachment : pass.attachments)
            unseen += texelOf(uint2(0), first->size, sizeOf(attachment)) ? 0 : 1;
    return unseen;
}

void dropUnseen(InspectedFrame& frame) {
    for (CapturedPass& pass : frame.inside.passes)
        for (CapturedAttachment& attachment : pass.attachments)
            if (!texelOf(uint2(0), frame.size, sizeOf(attachment))) attachment.bytes = {};
}

} // namespace filament_core::view
