// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/GraphModel.h"

#include "tools/view/panels/DemandRows.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <unordered_map>

namespace filament_core::view {
namespace {

/// "p12", "t3" or "b0": a pass, a texture or a buffer.
struct GraphName {
    char kind = 0;
    uint32_t index = 0;
    uint64_t key() const { return uint64_t{ static_cast<unsigned char>(kind) } << 32 | index; }
};

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    return text;
}

/// Takes a name from the front of the text.
std::optional<GraphName> takeName(std::string_view& text) {
    text = trimmed(text);
    if (text.size() < 2 || (text[0] != 'p' && text[0] != 't' && text[0] != 'b')) return std::nullopt;
    GraphName name{ .kind = text[0] };
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), name.index);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<size_t>(end - text.data()));
    return name;
}

/// The text of label="...", with line breaks as ", ".
std::string labelOf(std::string_view text) {
    constexpr std::string_view kLabel = "label=\"";
    const size_t begin = text.find(kLabel);
    if (begin == std::string_view::npos) return {};
    std::string label;
    for (size_t i = begin + kLabel.size(); i < text.size() && text[i] != '"'; ++i) {
        if (text[i] != '\\' || i + 1 == text.size()) {
            label += text[i];
        } else {
            ++i;
            if (text[i] == 'n')
                label += ", ";
            else
                label += text[i];
        }
    }
    return label;
}

class GraphReader {
public:
    void line(std::string_view text) {
        const std::optional<GraphName> first = takeName(text);
        if (!first) return;
        text = trimmed(text);
        if (!text.starts_with("->")) return addNode(*first, text);
        text.remove_prefix(2);
        if (const std::optional<GraphName> second = takeName(text)) addEdge(*first, *second);
    }
    FrameGraphModel model;

private:
    void addNode(GraphName name, std::string_view text) {
        if (name.kind != 'p') {
            mLabels[name.key()] = labelOf(text);
            return;
        }
        // passes of merged groups come last: their places are those of their numbers
        if (name.index >= kMostPasses) return;
        if (name.index >= model.boxes.size()) model.boxes.resize(size_t{ name.index } + 1);
        model.boxes[name.index].name = labelOf(text);
        model.boxes[name.index].runs = text.find("dashed") == std::string_view::npos;
    }
    /// Edges come in the order of the passes: who wrote last is known.
    void addEdge(GraphName first, GraphName second) {
        const bool isRead = second.kind == 'p';
        const GraphName pass = isRead ? second : first, resource = isRead ? first : second;
        if (pass.kind != 'p' || resource.kind == 'p' || pass.index >= model.boxes.size()) return;
        const auto writer = mWriters.find(resource.key());
        if (writer != mWriters.end() && writer->second < pass.index) addArrow(writer->second, pass.index, resource);
        if (!isRead) mWriters[resource.key()] = pass.index;
    }
    void addArrow(uint32_t from, uint32_t to, GraphName resource) {
        std::string const& label = mLabels[resource.key()];
        const bool isKnown = std::ranges::any_of(model.arrows, [&](GraphArrow const& arrow) {
            return arrow.from == from && arrow.to == to && arrow.resource == label;
        });
        if (!isKnown) model.arrows.push_back({ from, to, label });
    }

    static constexpr uint32_t kMostPasses = 4096;
    std::unordered_map<uint64_t, std::string> mLabels;
    std::unordered_map<uint64_t, uint32_t> mWriters;
};

void layOut(FrameGraphModel& graph) {
    std::ranges::stable_sort(graph.arrows, {}, &GraphArrow::to); // so that columns of what is read are final
    for (GraphArrow const& arrow : graph.arrows) {
        uint32_t& column = graph.boxes[arrow.to].column;
        column = std::max(column, graph.boxes[arrow.from].column + 1);
    }
    std::vector<uint32_t> used;
    for (GraphBox& box : graph.boxes) {
        if (box.column >= used.size()) used.resize(size_t{ box.column } + 1);
        box.row = used[box.column]++;
        graph.rows = std::max(graph.rows, used[box.column]);
    }
    graph.columns = static_cast<uint32_t>(used.size());
}

} // namespace

FrameGraphModel graphOf(std::string_view graphviz, std::vector<EffectDecision> const& decisions) {
    GraphReader reader;
    while (!graphviz.empty()) {
        const size_t end = std::min(graphviz.find('\n'), graphviz.size());
        reader.line(graphviz.substr(0, end));
        graphviz.remove_prefix(std::min(end + 1, graphviz.size()));
    }
    FrameGraphModel graph = std::move(reader.model);
    size_t box = 0;
    for (EffectDecision const& decision : decisions) {
        if (!isPass(decision) || box == graph.boxes.size()) continue;
        GraphBox& pass = graph.boxes[box++];
        pass.milliseconds = decision.gpuMilliseconds;
        pass.attachmentBytes = decision.attachmentBytes;
        pass.reason = decision.reason;
    }
    layOut(graph);
    return graph;
}

} // namespace filament_core::view
