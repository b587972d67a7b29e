// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Vertices.h"

namespace filament_core::backend::gles {

Vertices::~Vertices() {
    for (auto const& array : mArrays) {
        mDevice.state.forgetVertexArray(array->name);
        mDevice.gl.DeleteVertexArrays(1, &array->name);
    }
}

VertexArray& Vertices::get(VertexLayout const& layout) {
    for (auto const& array : mArrays) {
        if (array->layout == layout) return *array;
    }
    VertexArray& array = *mArrays.emplace_back(std::make_unique<VertexArray>());
    array.layout = layout;
    mDevice.gl.GenVertexArrays(1, &array.name);
    mDevice.state.bindVertexArray(array.name);
    describe(array);
    return array;
}

void Vertices::describe(VertexArray const& array) {
    Api const& gl = mDevice.gl;
    for (uint32_t i = 0; i < array.layout.attributeCount; ++i) {
        VertexAttribute const& attribute = array.layout.attributes[i];
        VertexFormatInfo const& info = vertexFormatInfo(attribute.format);
        const GLenum type = glVertexType(attribute.format);
        if (info.integer) {
            gl.VertexAttribIFormat(attribute.location, info.components, type, attribute.offset);
        } else {
            gl.VertexAttribFormat(attribute.location, info.components, type, info.normalized, attribute.offset);
        }
        gl.VertexAttribBinding(attribute.location, attribute.buffer);
        gl.EnableVertexAttribArray(attribute.location);
    }
    for (uint32_t i = 0; i < array.layout.bufferCount; ++i) {
        gl.VertexBindingDivisor(i, array.layout.buffers[i].perInstance ? 1 : 0);
    }
}

bool Vertices::bind(VertexArray& array, VertexSources const& sources, bool indexed, DrawBase base) {
    if (indexed && sources.indexBuffer == 0) return false;
    mDevice.state.bindVertexArray(array.name);
    for (uint32_t i = 0; i < array.layout.bufferCount; ++i) {
        VertexBufferLayout const& layout = array.layout.buffers[i];
        VertexArray::Slot wanted = sources.slots[i];
        if (wanted.buffer == 0) return false;
        const int64_t first = layout.perInstance ? static_cast<int64_t>(base.instance) : base.vertex;
        wanted.offset += static_cast<GLintptr>(first * layout.stride);
        if (wanted == array.slots[i]) continue;
        array.slots[i] = wanted;
        mDevice.gl.BindVertexBuffer(i, wanted.buffer, wanted.offset, layout.stride);
    }
    if (indexed && array.indexBuffer != sources.indexBuffer) {
        array.indexBuffer = sources.indexBuffer;
        mDevice.gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, sources.indexBuffer);
    }
    return true;
}

void Vertices::forget(GLuint buffer) {
    // Deleting a buffer unbinds it only from the current vertex array; the others would keep its memory and, later,
    // refer to a reused name.
    for (auto const& array : mArrays) {
        for (uint32_t i = 0; i < kMaxVertexBuffers; ++i) {
            if (array->slots[i].buffer != buffer) continue;
            mDevice.state.bindVertexArray(array->name);
            mDevice.gl.BindVertexBuffer(i, 0, 0, 0);
            array->slots[i] = {};
        }
        if (array->indexBuffer == buffer) {
            mDevice.state.bindVertexArray(array->name);
            mDevice.gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
            array->indexBuffer = 0;
        }
    }
}

} // namespace filament_core::backend::gles
