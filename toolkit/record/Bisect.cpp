// SPDX-License-Identifier: Apache-2.0
#include "toolkit/record/Bisect.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace filament_core::tools {
namespace {

using backend::CapturedAttachment;
using backend::CapturedFrame;
using backend::CapturedPass;

/// The position of an attachment in a frame.
struct At {
    size_t pass = 0, attachment = 0;
};

CapturedAttachment const& attachmentAt(CapturedFrame const& frame, At at) {
    return frame.passes[at.pass].attachments[at.attachment];
}

std::optional<PixelDifference> difference(CapturedFrame const& a, CapturedFrame const& b, At at) {
    CapturedAttachment const& x = attachmentAt(a, at);
    return firstDifference(x.format, x.width, x.bytes, attachmentAt(b, at).bytes);
}

Result<void> requireEqualPasses(CapturedFrame const& a, CapturedFrame const& b) {
    const auto differ = [](std::string const& what) {
        return Result<void>(fail(ErrorCode::Unsupported, "the two frames cannot be compared pass by pass: {}", what));
    };
    if (a.passes.size() != b.passes.size() || a.draws.size() != b.draws.size())
        return differ(fmt::format("{} and {} passes, {} and {} draws", a.passes.size(), b.passes.size(), a.draws.size(),
                                  b.draws.size()));
    for (size_t i = 0; i < a.passes.size(); ++i) {
        CapturedPass const &x = a.passes[i], &y = b.passes[i];
        if (x.name != y.name || x.attachments.size() != y.attachments.size())
            return differ(fmt::format("pass {} is '{}' and '{}'", i, x.name, y.name));
        for (size_t k = 0; k < x.attachments.size(); ++k) {
            if (x.attachments[k].bytes.size() != y.attachments[k].bytes.size())
                return differ(fmt::format("attachment '{}' of pass '{}' has {} and {} bytes", x.attachments[k].name,
                                          x.name, x.attachments[k].bytes.size(), y.attachments[k].bytes.size()));
        }
    }
    return {};
}

/// In a merged pass the attachment written first comes first, so that the first difference is the earliest.
std::optional<At> firstDifferent(CapturedFrame const& a, CapturedFrame const& b) {
    for (size_t pass = 0; pass < a.passes.size(); ++pass) {
        for (size_t i = 0; i < a.passes[pass].attachments.size(); ++i) {
            if (difference(a, b, { pass, i })) return At{ pass, i };
        }
    }
    return std::nullopt;
}

Disagreement describe(CapturedPass const& pass, CapturedAttachment const& attachment, PixelDifference const& pixel) {
    return { .pass = pass.name,
             .attachment = attachment.name,
             .passFirst = pass.first,
             .passLast = pass.last,
             .format = attachment.format,
             .pixel = pixel };
}

Disagreement describe(CapturedFrame const& a, CapturedFrame const& b, At at) {
    return describe(a.passes[at.pass], attachmentAt(a, at), *difference(a, b, at));
}

bool isMergedOtherwise(CapturedFrame const& a, CapturedFrame const& b) {
    return a.passes.size() != b.passes.size() && a.draws.size() == b.draws.size();
}

using Contents = std::vector<CapturedAttachment const*>;

/// What attachments of that name and size hold after the passes of a frame, in their order.
Contents contentsOf(CapturedFrame const& frame, CapturedAttachment const& like) {
    Contents contents;
    for (CapturedPass const& pass : frame.passes)
        for (CapturedAttachment const& attachment : pass.attachments)
            if (attachment.name == like.name && attachment.bytes.size() == like.bytes.size())
                contents.push_back(&attachment);
    return contents;
}

bool haveOneInCommon(Contents const& a, Contents const& b) {
    return std::ranges::any_of(a, [&](CapturedAttachment const* x) {
        return std::ranges::any_of(b, [&](CapturedAttachment const* y) { return x->bytes == y->bytes; });
    });
}

/// Passes that are not merged use a texture again for what a merged pass keeps in a tile, so it need not hold the same
/// in the end; but what one frame computes, the other one computes somewhere.
std::optional<Disagreement> compareContents(CapturedFrame const& a, CapturedFrame const& b) {
    for (CapturedPass const& pass : a.passes) {
        for (CapturedAttachment const& x : pass.attachments) {
            const Contents ofA = contentsOf(a, x), ofB = contentsOf(b, x);
            if (ofB.empty() || haveOneInCommon(ofA, ofB)) continue;
            return describe(pass, x, *firstDifference(x.format, x.width, x.bytes, ofB.back()->bytes));
        }
    }
    return std::nullopt;
}

/// How the attachment differs if both frames end after `draws` draws.
Result<std::optional<PixelDifference>> after(FrameSource const& a, FrameSource const& b, At at, uint32_t draws) {
    Result<CapturedFrame> x = a(draws);
    if (!x) return x.error();
    Result<CapturedFrame> y = b(draws);
    if (!y) return y.error();
    if (const Result<void> equal = requireEqualPasses(*x, *y); !equal) return equal.error();
    return difference(*x, *y, at);
}

/// Narrows (good, bad] to one draw: after `good` draws the attachments agree, after `bad` they do not.
Result<void> findDraw(FrameSource const& a, FrameSource const& b, At at, CapturedFrame const& frame,
                      Disagreement& found) {
    CapturedPass const& pass = frame.passes[at.pass];
    uint32_t good = pass.firstDraw, bad = pass.firstDraw + pass.drawCount;
    found.afterDraw = found.pixel;
    auto before = after(a, b, at, good);
    if (!before) return before.error();
    if (*before || good == bad) return {}; // the difference is in the clear or in loaded contents
    while (bad - good > 1) {
        const uint32_t middle = good + (bad - good) / 2;
        auto differs = after(a, b, at, middle);
        if (!differs) return differs.error();
        if (*differs) found.afterDraw = **differs;
        (*differs ? bad : good) = middle;
    }
    found.hasDraw = true;
    found.draw = bad;
    found.drawPosition = frame.draws[bad - 1].position;
    found.pipeline = frame.draws[bad - 1].pipeline;
    return {};
}

} // namespace

std::string Disagreement::line() const {
    std::string text = fmt::format("pass '{}' (commands {} to {}), attachment '{}' ({}): ", pass, passFirst, passLast,
                                   attachment, backend::formatInfo(format).name);
    if (hasDraw)
        text += fmt::format("draw {} of the frame (command {}, pipeline '{}'), ", draw, drawPosition, pipeline);
    PixelDifference const& shown = hasDraw ? afterDraw : pixel;
    return text + fmt::format("pixel ({}, {}) is {} and {}; {} pixels differ {}", shown.x, shown.y, textOf(shown.a),
                              textOf(shown.b), shown.count, hasDraw ? "after it" : "after the pass");
}

Result<std::optional<Disagreement>> compareFrames(CapturedFrame const& a, CapturedFrame const& b) {
    if (isMergedOtherwise(a, b)) return compareContents(a, b);
    if (const Result<void> equal = requireEqualPasses(a, b); !equal) return equal.error();
    const std::optional<At> at = firstDifferent(a, b);
    return at ? std::optional(describe(a, b, *at)) : std::nullopt;
}

Result<std::optional<Disagreement>> bisect(FrameSource const& a, FrameSource const& b) {
    Result<CapturedFrame> x = a(backend::kAllDraws);
    if (!x) return x.error();
    Result<CapturedFrame> y = b(backend::kAllDraws);
    if (!y) return y.error();
    if (isMergedOtherwise(*x, *y)) return compareContents(*x, *y);
    if (const Result<void> equal = requireEqualPasses(*x, *y); !equal) return equal.error();
    const std::optional<At> at = firstDifferent(*x, *y);
    if (!at) return std::optional<Disagreement>();
    Disagreement found = describe(*x, *y, *at);
    if (const Result<void> narrowed = findDraw(a, b, *at, *x, found); !narrowed) return narrowed.error();
    return std::optional(found);
}

} // namespace filament_core::tools
