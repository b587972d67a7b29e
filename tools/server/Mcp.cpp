// SPDX-License-Identifier: Apache-2.0
#include "tools/server/Mcp.h"

#include "toolkit/json/JsonFile.h"

#include <filament_core/SceneFile.h>
#include <filament_core/Version.h>

#include <nlohmann/json.hpp>

#include <string>

namespace filament_core::server {
namespace {

using tools::Json;

constexpr const char* kRevision = "2025-03-26";
constexpr int kParseError = -32700, kInvalidRequest = -32600, kNoMethod = -32601,
              kInvalidParams = -32602; // JSON-RPC 2.0, 5.1

Json requestSchema() {
    return { { "type", "object" },
             { "properties",
               { { "scene", { { "type", "object" }, { "description", "a scene file: see the tool scene_schema" } } },
                 { "sceneFile", { { "type", "string" }, { "description", "one in the server's folder of scenes" } } },
                 { "set", { { "type", "object" }, { "description", "keys of the scene and their values" } } },
                 { "size",
                   { { "type", "array" },
                     { "items", { { "type", "integer" } } },
                     { "description", "pixels: width, height" } } },
                 { "api", { { "enum", { "gles", "vulkan" } } } } } } };
}

Json tools() {
    const Json nothing = { { "type", "object" }, { "properties", Json::object() } };
    return {
        { { "name", "render_scene" },
          { "description", "Draws a scene file with a physically based renderer, and gives the image." },
          { "inputSchema", requestSchema() } },
        { { "name", "check_scene" },
          { "description", "Says what is wrong with a request to draw, without drawing it." },
          { "inputSchema", requestSchema() } },
        { { "name", "scene_schema" }, { "description", "The JSON schema of scene files." }, { "inputSchema", nothing } }
    };
}

Json content(Json item, bool isError) {
    return { { "content", Json::array({ std::move(item) }) }, { "isError", isError } };
}

Json textContent(std::string const& text, bool isError = false) {
    return content({ { "type", "text" }, { "text", text } }, isError);
}

Json resultOf(Answer const& answer) {
    if (answer.status == 200 && answer.contentType.starts_with("image/"))
        return content({ { "type", "image" }, { "data", base64(answer.body) }, { "mimeType", answer.contentType } },
                       false);
    return textContent(answer.body, answer.status >= 400);
}

/// Nothing: there is no such tool.
std::optional<Json> callTool(RenderService& service, std::string const& name, Json const& arguments) {
    if (name == "render_scene") return resultOf(service.render(arguments.dump()));
    if (name == "check_scene") return resultOf(service.check(arguments.dump()));
    if (name == "scene_schema") return textContent(SceneFile::schema());
    return std::nullopt;
}

std::string errorMessage(Json const& id, int code, const char* text) {
    return Json{ { "jsonrpc", "2.0" }, { "id", id }, { "error", { { "code", code }, { "message", text } } } }.dump();
}

} // namespace

std::string base64(std::string_view bytes) {
    constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](size_t at) { return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0u; };
        const uint32_t group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
        for (int j = 0; j < 4; ++j) {
            const bool isThere = i + static_cast<size_t>(j) <= bytes.size();
            out += isThere ? kLetters[group >> (18 - 6 * j) & 63u] : '=';
        }
    }
    return out;
}

std::optional<std::string> answerMcp(RenderService& service, std::string_view message) {
    const Result<Json> parsed = tools::parseJson(message, "message");
    if (!parsed) return errorMessage(nullptr, kParseError, "the message is no JSON");
    const auto isText = [&](const char* member) { return parsed->contains(member) && (*parsed)[member].is_string(); };
    if (!parsed->is_object() || !isText("jsonrpc") || (*parsed)["jsonrpc"] != "2.0" || !isText("method"))
        return errorMessage(nullptr, kInvalidRequest, "the message is no request of JSON-RPC 2.0");
    if (!parsed->contains("id")) return std::nullopt; // a notification
    Json const id = (*parsed)["id"];
    const std::string method = (*parsed)["method"];
    const Json parameters = parsed->value("params", Json::object());
    const auto answer = [&](Json const& result) {
        return Json{ { "jsonrpc", "2.0" }, { "id", id }, { "result", result } }.dump();
    };
    if (method == "initialize")
        return answer({ { "protocolVersion", kRevision },
                        { "capabilities", { { "tools", Json::object() } } },
                        { "serverInfo", { { "name", "filament-server" }, { "version", versionText() } } } });
    if (method == "ping") return answer(Json::object());
    if (method == "tools/list") return answer({ { "tools", tools() } });
    if (method != "tools/call") return errorMessage(id, kNoMethod, "there is no such method");
    if (!parameters.is_object() || !parameters.contains("name") || !parameters["name"].is_string())
        return errorMessage(id, kInvalidParams, "params.name is the name of a tool");
    const std::optional<Json> result =
            callTool(service, parameters["name"], parameters.value("arguments", Json::object()));
    return result ? answer(*result) : errorMessage(id, kInvalidParams, "there is no such tool");
}

void serveMcp(RenderService& service, std::istream& in, std::ostream& out) {
    for (std::string line; std::getline(in, line);) {
        if (line.empty()) continue;
        if (const std::optional<std::string> answer = answerMcp(service, line)) out << *answer << '\n' << std::flush;
    }
}

} // namespace filament_core::server
