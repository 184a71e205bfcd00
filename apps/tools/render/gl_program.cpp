// SPDX-License-Identifier: Apache-2.0
// Shaders in GLSL ES 3.00.
#include "apps/tools/render/gl_program.hpp"

#include <string>

namespace tetrakis::tools {
namespace {

constexpr const char* kVertexShader = R"(#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 paint;
uniform mat4 transform;
out highp vec3 varied;
void main() {
  varied = paint;
  gl_Position = transform * vec4(position, 1.0);
})";

constexpr const char* kTextureShader = R"(#version 300 es
precision highp float;
uniform sampler2D image;
in highp vec3 varied;
out vec4 colour;
void main() {
  vec4 texel = texture(image, varied.xy);
  if (texel.a < 0.5) discard;
  colour = vec4(texel.rgb / texel.a, 1.0);
})";

// Lambert from the north-west, as maps are shaded, and a pale sky all around.
constexpr const char* kHillshadeShader = R"(#version 300 es
precision highp float;
in highp vec3 varied;
out vec4 colour;
const vec3 kSun = vec3(-0.53, 0.66, -0.53);
const vec3 kGround = vec3(0.95, 0.93, 0.89);
void main() {
  vec3 normal = normalize(varied);
  float sun = max(dot(normal, kSun), 0.0);
  float sky = 0.5 + 0.5 * normal.y;
  colour = vec4(min(kGround * (0.74 * sun + 0.28 * sky), 1.0), 1.0);
})";

/// Each texture has an output of its own, whose colours are as above where alpha is 1.
std::string manyTexturesShader(GLuint textures) {
  const std::string count = std::to_string(textures);
  std::string outputs, body;
  for (GLuint i = 0; i < textures; ++i) {
    const std::string number = std::to_string(i);
    outputs += "layout(location = " + number + ") out vec4 colour" + number + ";\n";
    body += "colour" + number + " = vec4(texture(images[" + number + "], varied.xy).rgb, 1.0);\n";
  }
  return "#version 300 es\nprecision highp float;\nuniform sampler2D images[" + count +
         "];\nin highp vec3 varied;\n" + outputs + "void main() {\n" + body + "}";
}

std::string shaderLog(GLuint shader) {
  std::string log(512, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<size_t>(length));
  return log;
}

Status attach(GLuint program, GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  glAttachShader(program, shader);
  const std::string log = compiled ? "" : shaderLog(shader);
  glDeleteShader(shader);
  if (compiled) return Status();
  return Status(TKS_UNSUPPORTED, "cannot draw: the OpenGL driver refuses a shader: " + log);
}

}  // namespace

GlProgram::~GlProgram() {
  if (program_ != 0) glDeleteProgram(program_);
}

Status GlProgram::build(Paint paint) {
  return buildWith(paint == Paint::kTexture ? kTextureShader : kHillshadeShader);
}

Status GlProgram::buildMany(GLuint textures) {
  if (Status status = buildWith(manyTexturesShader(textures).c_str()); !status.ok()) return status;
  constexpr std::array<GLint, kTexturesAtOnce> kUnits = {0, 1, 2, 3};
  glUseProgram(program_);
  glUniform1iv(glGetUniformLocation(program_, "images"), static_cast<GLsizei>(textures),
               kUnits.data());
  return Status();
}

Status GlProgram::buildWith(const char* fragment_shader) {
  program_ = glCreateProgram();
  if (Status status = attach(program_, GL_VERTEX_SHADER, kVertexShader); !status.ok())
    return status;
  if (Status status = attach(program_, GL_FRAGMENT_SHADER, fragment_shader); !status.ok())
    return status;
  glLinkProgram(program_);
  GLint linked = GL_FALSE;
  glGetProgramiv(program_, GL_LINK_STATUS, &linked);
  if (!linked)
    return Status(TKS_UNSUPPORTED, "cannot draw: the OpenGL driver does not link shaders");
  transform_ = glGetUniformLocation(program_, "transform");
  return Status();
}

void GlProgram::use(const std::array<float, 16>& transform) const {
  glUseProgram(program_);
  glUniformMatrix4fv(transform_, 1, GL_FALSE, transform.data());
}

}  // namespace tetrakis::tools
