// Spheres and cylinders by WebGL2: each is a rectangle that faces the reader, and the fragment shader finds the exact
// surface, its depth and its light. The projection is parallel, so the outline of a sphere is a circle.
// Rectangle k takes vertices 6 k to 6 k + 5 and reads row k of its textures: one call draws all of them, also where
// instances are drawn one by one (software rendering).
const WIDE = 2048; // of the textures; every device has room for that
const RECTANGLE = `#version 300 es
precision highp float; precision highp sampler2D;
uniform sampler2D start, tint, stop, move, moveStop;
uniform float phase; // of the oscillation; 0: the packing itself
const vec2 corners[6] = vec2[6](vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(-1, 1), vec2(1, -1), vec2(1, 1));
ivec2 row() { return ivec2(gl_VertexID / 6 % ${WIDE}, gl_VertexID / 6 / ${WIDE}); }`;
const SPHERE_VERTEX = RECTANGLE + `
uniform mat3 turn; uniform vec2 scale; uniform vec2 shift; uniform float depth;
out vec2 at; out vec3 shade; out float z, r;
void main() {
  vec4 sphere = texelFetch(start, row(), 0);   // centre and radius
  vec2 corner = corners[gl_VertexID % 6];
  vec3 away = phase == 0.0 ? vec3(0) : phase * texelFetch(move, row(), 0).xyz;
  vec3 c = turn * (sphere.xyz + away);
  at = corner; r = sphere.w; z = c.z; shade = texelFetch(tint, row(), 0).rgb;
  gl_Position = vec4((c.xy + corner * r + shift) * scale, -c.z / depth, 1.0);
}`;
const SPHERE_FRAGMENT = `#version 300 es
precision highp float;
in vec2 at; in vec3 shade; in float z, r;
uniform float depth, flatness; uniform vec3 light;
out vec4 colour;
void main() {
  float q = dot(at, at);
  if (q > 1.0) discard;
  vec3 normal = vec3(at, sqrt(1.0 - q));
  float bright = mix(0.42 + 0.58 * max(dot(normal, light), 0.0), 1.0, flatness);
  bright *= 1.0 - 0.35 * smoothstep(0.86, 1.0, q) * mix(0.6, 1.0, flatness);
  bright *= mix(0.82 + 0.18 * clamp(z / depth * 2.0 + 0.5, 0.0, 1.0), 1.0, flatness);
  gl_FragDepth = 0.5 - 0.5 * (z + mix(r * normal.z, 0.0, flatness)) / depth;
  colour = vec4(shade * bright, 1.0);
}`;
const STICK_VERTEX = RECTANGLE + `
uniform mat3 turn; uniform vec2 scale; uniform vec2 shift; uniform float depth, lift;
out float across, z, r; out vec3 shade;
void main() {
  vec4 first = texelFetch(start, row(), 0);   // one end and the radius
  vec2 corner = corners[gl_VertexID % 6];
  vec3 from = vec3(0), to = vec3(0);
  if (phase != 0.0) {
    from = phase * texelFetch(move, row(), 0).xyz;
    to = phase * texelFetch(moveStop, row(), 0).xyz;
  }
  vec3 a = turn * (first.xyz + from), b = turn * (texelFetch(stop, row(), 0).xyz + to);
  vec2 along = b.xy - a.xy;
  float size = length(along);
  vec2 side = size > 1e-9 ? vec2(-along.y, along.x) / size : vec2(1.0, 0.0);
  vec3 c = mix(a, b, 0.5 * corner.y + 0.5);
  across = corner.x; r = first.w; z = c.z + lift; shade = texelFetch(tint, row(), 0).rgb;
  gl_Position = vec4((c.xy + side * corner.x * r + shift) * scale, -z / depth, 1.0);
}`;
const STICK_FRAGMENT = `#version 300 es
precision highp float;
in float across, z, r; in vec3 shade;
uniform float depth;
out vec4 colour;
void main() {
  float up = sqrt(max(1.0 - across * across, 0.0));
  gl_FragDepth = 0.5 - 0.5 * (z + r * up) / depth;
  colour = vec4(shade * (0.45 + 0.55 * up), 1.0);
}`;

function makeRenderer(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) return null;
  const compile = (type, text) => {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    return shader;
  };
  const link = (vertex, fragment) => {
    const program = gl.createProgram();
    gl.attachShader(program, compile(gl.VERTEX_SHADER, vertex));
    gl.attachShader(program, compile(gl.FRAGMENT_SHADER, fragment));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    return program;
  };

  // One kind of shape: its program and its textures by name.
  const shape = (vertex, fragment, names) => {
    const program = link(vertex, fragment), textures = {};
    for (const name of names) {
      textures[name] = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, textures[name]);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, 1, 1, 0, gl.RGBA, gl.FLOAT, new Float32Array(4));
    }
    return { program, textures, count: 0, least: 0, at: (name) => gl.getUniformLocation(program, name) };
  };
  const spheres = shape(SPHERE_VERTEX, SPHERE_FRAGMENT, ["start", "tint", "move"]);
  const sticks = shape(STICK_VERTEX, STICK_FRAGMENT, ["start", "tint", "stop", "move", "moveStop"]);
  gl.bindVertexArray(gl.createVertexArray());
  const fill = (kind, arrays, count, least = 0) => {
    const high = Math.max(1, Math.ceil(count / WIDE));
    for (const name in arrays) {
      const bytes = arrays[name] instanceof Uint8Array, whole = new arrays[name].constructor(4 * WIDE * high);
      whole.set(arrays[name]);
      gl.bindTexture(gl.TEXTURE_2D, kind.textures[name]);
      gl.texImage2D(gl.TEXTURE_2D, 0, bytes ? gl.RGBA8 : gl.RGBA32F, WIDE, high, 0, gl.RGBA,
        bytes ? gl.UNSIGNED_BYTE : gl.FLOAT, whole);
    }
    kind.count = count;
    kind.least = least;
  };

  // share: of each kind, the first instances, but for the `least` that are always drawn; phase: of the oscillation.
  function draw(view, share = 1, phase = 0) {
    const { width, height } = canvas;
    gl.viewport(0, 0, width, height);
    gl.clearColor(0.965, 0.969, 0.976, 1);
    gl.enable(gl.DEPTH_TEST);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    for (const kind of [spheres, sticks]) {
      if (!kind.count) continue;
      gl.useProgram(kind.program);
      gl.uniformMatrix3fv(kind.at("turn"), true, view.turn);
      gl.uniform2f(kind.at("scale"), view.scale / (0.5 * width), view.scale / (0.5 * height));
      gl.uniform2f(kind.at("shift"), view.shift[0], view.shift[1]);
      gl.uniform1f(kind.at("depth"), view.depth);
      gl.uniform1f(kind.at("flatness"), view.flat ? 1 : 0);
      gl.uniform1f(kind.at("lift"), view.flat ? 0.25 * view.depth : 0);
      gl.uniform3f(kind.at("light"), -0.42, 0.57, 0.705);
      Object.keys(kind.textures).forEach((name, unit) => {
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, kind.textures[name]);
        gl.uniform1i(kind.at(name), unit);
      });
      gl.uniform1f(kind.at("phase"), phase);
      gl.drawArrays(gl.TRIANGLES, 0, 6 * (kind.least + Math.ceil((kind.count - kind.least) * share)));
    }
  }
  const pixel = new Uint8Array(4);
  return {
    spheres: (arrays, count) => fill(spheres, arrays, count),
    sticks: (arrays, count, least) => fill(sticks, arrays, count, least),
    draw,
    finish: () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel), // waits until all is drawn
  };
}
