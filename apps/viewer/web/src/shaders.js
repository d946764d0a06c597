// SPDX-License-Identifier: GPL-3.0-or-later
// Shaders. Spheres and cylinders with round ends are found by a ray for each pixel, so they are exact at any
// distance; depth is that of the hit, so they cut each other and facets as they should. Lengths in view space.

// How all things are coloured, lit and sliced.
const kCommon = `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform mat4 projectionMatrix;
uniform sampler2D colours;
uniform vec2 range;
uniform int colouring;      // 0 one colour, 1 linear, 2 logarithmic, 3 categories
uniform vec3 plain;
uniform vec4 slice;         // kept: dot(slice.xyz, x) + slice.w < 0
uniform int sliced;
uniform int parallel;
uniform float ghost;        // opacity at the middle; 1 for solid
out vec4 shown;

vec3 colour_of(float value) {
  if (colouring == 0) return plain;
  if (colouring == 3) return texture(colours, vec2((mod(floor(value + 0.5), 256.0) + 0.5) / 256.0, 0.5)).rgb;
  float t = colouring == 2 ? log(max(value, 1e-37) / range.x) / log(range.y / range.x)
                           : (value - range.x) / (range.y - range.x);
  if (t != t) return vec3(0.6);
  return texture(colours, vec2((clamp(t, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
}

bool is_cut_off(vec3 x) { return sliced == 1 && dot(slice.xyz, x) + slice.w > 0.0; }

// A key light over the viewer's left shoulder, a fill light from below on the right, sky and a mild gloss.
vec3 lit(vec3 colour, vec3 normal, vec3 to_eye) {
  vec3 key = normalize(vec3(-0.45, 0.75, 0.65));
  float direct = max(dot(normal, key), 0.0);
  float fill = max(dot(normal, normalize(vec3(0.8, -0.25, 0.5))), 0.0);
  float sky = 0.5 + 0.5 * normal.y;
  float gloss = pow(max(dot(normal, normalize(key + to_eye)), 0.0), 40.0);
  float rim = pow(1.0 - max(dot(normal, to_eye), 0.0), 3.0);
  vec3 linear = pow(colour, vec3(2.2));
  vec3 light = linear * (0.34 + 0.20 * sky + 0.80 * direct + 0.16 * fill) + vec3(0.10) * gloss;
  light *= 1.0 - 0.35 * rim;
  // What would be brighter than white keeps its shading: a shoulder above three quarters.
  light = mix(light, 1.0 - 0.25 * exp(-4.0 * (light - 0.75)), step(0.75, light));
  return pow(clamp(light, 0.0, 1.0), vec3(1.0 / 2.2));
}

// The face of a cut: flat, so that it reads as cut.
vec3 cut_face(vec3 colour) { return mix(colour, vec3(1.0), 0.18); }

void show(vec3 x, vec3 normal, vec3 colour, bool is_cut) {
  vec4 clip = projectionMatrix * vec4(x, 1.0);
  gl_FragDepth = clamp(0.5 * clip.z / clip.w + 0.5, 0.0, 1.0);
  vec3 to_eye = parallel == 1 ? vec3(0.0, 0.0, 1.0) : normalize(-x);
  float opacity = 1.0;
  if (ghost < 1.0) {
    float facing = clamp(abs(dot(normal, to_eye)), 0.0, 1.0);
    opacity = ghost + (0.5 - 0.5 * ghost) * pow(1.0 - facing, 3.0);
  }
  shown = vec4(is_cut ? cut_face(colour) : lit(colour, normal, to_eye), opacity);
}
`;

const kVertexCommon = `
precision highp float;
precision highp int;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform int parallel;
in vec3 position;
`;

export const sphereVertex = kVertexCommon + `
in vec4 sphere;             // centre, radius
in float value;
out vec3 on_quad;
flat out vec4 ball;
flat out float sphere_value;
void main() {
  vec3 c = (modelViewMatrix * vec4(sphere.xyz, 1.0)).xyz;
  float r = sphere.w, d = length(c);
  vec3 ahead = parallel == 1 ? vec3(0.0, 0.0, -1.0) : c / d;
  // In perspective the outline is a larger circle about the centre: r d / sqrt(d^2 - r^2).
  float half_width = parallel == 1 ? r : (d > 1.01 * r ? r * d / sqrt(d * d - r * r) : 0.0);
  vec3 u = normalize(cross(ahead, abs(ahead.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
  vec3 v = cross(u, ahead);
  on_quad = c + half_width * (position.x * u + position.y * v);
  ball = vec4(c, r);
  sphere_value = value;
  gl_Position = projectionMatrix * vec4(on_quad, 1.0);
}`;

export const sphereFragment = kCommon + `
in vec3 on_quad;
flat in vec4 ball;
flat in float sphere_value;
void main() {
  vec3 start = parallel == 1 ? vec3(on_quad.xy, 0.0) : vec3(0.0);
  vec3 ray = parallel == 1 ? vec3(0.0, 0.0, -1.0) : normalize(on_quad);
  vec3 to_centre = ball.xyz - start;
  float middle = dot(to_centre, ray);
  vec3 across = to_centre - middle * ray;
  float h = ball.w * ball.w - dot(across, across);
  if (h < 0.0) discard;
  vec3 x = start + (middle - sqrt(h)) * ray;
  vec3 normal = (x - ball.xyz) / ball.w;
  bool is_cut = false;
  if (is_cut_off(x)) {
    float t = -(dot(slice.xyz, start) + slice.w) / dot(slice.xyz, ray);
    x = start + t * ray;
    if (!(distance(x, ball.xyz) < ball.w)) discard;
    normal = slice.xyz;
    is_cut = true;
  }
  show(x, normal, colour_of(sphere_value), is_cut);
}`;

export const capsuleVertex = kVertexCommon + `
in vec4 from;               // end, radius
in vec3 to;
in vec2 values;             // at the ends
flat out vec4 end_a;
flat out vec3 end_b;
flat out vec2 end_values;
out vec3 on_box;
void main() {
  vec3 a = (modelViewMatrix * vec4(from.xyz, 1.0)).xyz;
  vec3 b = (modelViewMatrix * vec4(to, 1.0)).xyz;
  vec3 along = b - a;
  float l = length(along), r = from.w;
  vec3 w = l > 0.0 ? along / l : vec3(0.0, 0.0, 1.0);
  vec3 u = normalize(cross(w, abs(w.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
  vec3 v = cross(w, u);
  on_box = 0.5 * (a + b) + position.x * r * u + position.y * r * v + position.z * (0.5 * l + r) * w;
  end_a = vec4(a, r);
  end_b = b;
  end_values = values;
  gl_Position = projectionMatrix * vec4(on_box, 1.0);
}`;

// Distance along a ray to a segment swept by a ball; negative where it misses. The quadratics of the cylinder and
// of the ball at the nearer end; Ericson, Real-Time Collision Detection (2005), 5.3.7.
export const capsuleFragment = kCommon + `
flat in vec4 end_a;
flat in vec3 end_b;
flat in vec2 end_values;
in vec3 on_box;

float ball_entry(vec3 start, vec3 ray, vec3 c, float r) {
  vec3 to_centre = c - start;
  float middle = dot(to_centre, ray);
  vec3 across = to_centre - middle * ray;
  float h = r * r - dot(across, across);
  return h < 0.0 ? 1e30 : middle - sqrt(h);
}

float share_along(vec3 x, vec3 along) {
  float l2 = dot(along, along);
  return l2 > 0.0 ? clamp(dot(x - end_a.xyz, along) / l2, 0.0, 1.0) : 0.0;
}

void main() {
  vec3 start = parallel == 1 ? vec3(on_box.xy, 0.0) : vec3(0.0);
  vec3 ray = parallel == 1 ? vec3(0.0, 0.0, -1.0) : normalize(on_box);
  // The ray begins near the box, which keeps the digits of thin cylinders far away.
  float off = dot(on_box - start, ray) - 2.0 * (end_a.w + length(end_b - end_a.xyz));
  vec3 near = start + off * ray;
  vec3 along = end_b - end_a.xyz, to_start = near - end_a.xyz;
  float r = end_a.w, t = 1e30;
  float l2 = dot(along, along), lr = dot(along, ray), ls = dot(along, to_start);
  float a = l2 - lr * lr;
  if (a > 1e-9 * l2) {
    vec3 p = to_start - along * (ls / l2), q = ray - along * (lr / l2);
    float qq = dot(q, q), pq = dot(p, q), h = pq * pq - qq * (dot(p, p) - r * r);
    if (h >= 0.0) {
      float entry = (-pq - sqrt(h)) / qq, y = ls + entry * lr;
      if (y > 0.0 && y < l2) t = entry;
    }
  }
  if (t == 1e30) t = min(ball_entry(near, ray, end_a.xyz, r), ball_entry(near, ray, end_b, r));
  if (t == 1e30) discard;
  vec3 x = near + t * ray;
  float share = share_along(x, along);
  vec3 normal = normalize(x - end_a.xyz - share * along);
  bool is_cut = false;
  if (is_cut_off(x) || dot(x - start, ray) < 0.0) {
    if (sliced == 0) discard;
    x = start - ray * ((dot(slice.xyz, start) + slice.w) / dot(slice.xyz, ray));
    share = share_along(x, along);
    if (!(distance(x, end_a.xyz + share * along) < r)) discard;
    normal = slice.xyz;
    is_cut = true;
  }
  show(x, normal, colour_of(mix(end_values.x, end_values.y, share)), is_cut);
}`;

// A facet: its two sides, half a thickness off. Its rounded rims are capsules.
export const facetVertex = kVertexCommon + `
in vec4 corner_0;           // corner, half the thickness
in vec3 corner_1;
in vec3 corner_2;
in vec3 values;
in vec3 normal_0;           // of the surface around the corners, on one side
in vec3 normal_1;
in vec3 normal_2;
out vec3 in_view;
out vec3 surface_normal;
out float facet_value;
out vec3 weights;
void main() {                // position: which corner, which side
  int k = int(position.x);
  vec3 a = (modelViewMatrix * vec4(corner_0.xyz, 1.0)).xyz;
  vec3 b = (modelViewMatrix * vec4(corner_1, 1.0)).xyz;
  vec3 c = (modelViewMatrix * vec4(corner_2, 1.0)).xyz;
  vec3 n = cross(b - a, c - a);
  float l = length(n);
  n = l > 0.0 ? n / l : vec3(0.0);
  vec3 corner = k == 0 ? a : (k == 1 ? b : c);
  in_view = corner + position.y * corner_0.w * n;
  vec3 smooth_normal = k == 0 ? normal_0 : (k == 1 ? normal_1 : normal_2);
  surface_normal = position.y * (modelViewMatrix * vec4(smooth_normal, 0.0)).xyz;
  facet_value = k == 0 ? values.x : (k == 1 ? values.y : values.z);
  weights = vec3(k == 0, k == 1, k == 2);
  gl_Position = projectionMatrix * vec4(in_view, 1.0);
}`;

export const facetFragment = kCommon + `
uniform float mesh_lines;
in vec3 in_view;
in vec3 surface_normal;
in float facet_value;
in vec3 weights;
void main() {
  if (is_cut_off(in_view)) discard;
  vec3 colour = colour_of(facet_value);
  vec3 pixel = sqrt(dFdx(weights) * dFdx(weights) + dFdy(weights) * dFdy(weights));
  vec3 near_edge = smoothstep(vec3(0.0), 1.1 * pixel, weights);
  float off_edge = min(near_edge.x, min(near_edge.y, near_edge.z));
  // Where facets are but a few pixels wide their lines would be all there is to see.
  float room = 1.0 - smoothstep(0.05, 0.25, max(pixel.x, max(pixel.y, pixel.z)));
  if (gl_FrontFacing) colour *= 1.0 - mesh_lines * room * (1.0 - off_edge);
  // The back of a side is seen where a slice opened the facet: its inside.
  show(in_view, normalize(surface_normal), colour, !gl_FrontFacing);
}`;

export const planeVertex = kVertexCommon + `
uniform mat4 modelMatrix;
out vec3 in_view;
out vec2 on_plane;
out vec2 rim;
in vec2 uv;
uniform vec2 size;
uniform vec2 shift;
uniform vec2 ends;          // 1 where it ends, across and along; 0 where it goes all the way round
void main() {
  vec4 x = modelViewMatrix * vec4(position, 1.0);
  in_view = x.xyz;
  vec2 place = 2.0 * uv - 1.0;
  rim = ends * place;
  on_plane = place * size + shift;
  gl_Position = projectionMatrix * x;
}`;

// Front: a floor with a grid. Back: next to nothing, so that walls do not hide what they hold.
export const planeFragment = kCommon + `
uniform float spacing;
uniform vec3 grid;
uniform vec4 walls[12];     // the other planes: what is behind one of them is not shown
uniform int wall_count;
uniform vec4 middles[4];    // containers: a point of the axis, or the centre, and the radius
uniform vec3 axes[4];       // 0 of spheres
uniform int container_count;
uniform float slack;
in vec3 in_view;
in vec2 on_plane;
in vec2 rim;
float lines(float every) {
  vec2 x = on_plane / every, w = fwidth(x) * 0.8 + 1e-6;
  vec2 d = abs(fract(x - 0.5) - 0.5) / w;
  return (1.0 - min(min(d.x, d.y), 1.0)) * clamp(0.35 / max(w.x, w.y), 0.0, 1.0);
}
void main() {
  if (is_cut_off(in_view)) discard;
  for (int i = 0; i < wall_count; i++)
    if (dot(walls[i].xyz, in_view) + walls[i].w < -slack) discard;
  for (int i = 0; i < container_count; i++) {
    vec3 way = in_view - middles[i].xyz;
    if (length(way - dot(way, axes[i]) * axes[i]) > middles[i].w + slack) discard;
  }
  float line = max(lines(spacing), 0.45 * lines(spacing / 5.0));
  vec2 d = (1.0 - abs(rim)) / (fwidth(rim) * 1.2 + 1e-6);
  line = max(line, 1.0 - min(min(d.x, d.y), 1.0));
  gl_FragDepth = gl_FragCoord.z;
#ifdef BACK
  if (line < 0.05) discard;
  shown = vec4(grid, 0.28 * line);
#else
  shown = vec4(mix(plain, grid, 0.5 * line), 1.0);
#endif
}`;

export const screenVertex = `
in vec3 position;
out vec2 at;
void main() { at = 0.5 * position.xy + 0.5; gl_Position = vec4(position.xy, 0.0, 1.0); }`;

// Background, and how much of the sky each place sees: a spiral of places around it in the depth buffer, turned
// differently every time, since many such pictures are averaged. After McGuire et al., "Scalable ambient
// obscurance" (HPG 2012).
export const shadeFragment = `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D scene;
uniform sampler2D depth;
uniform mat4 unproject;      // inverse projection
uniform vec2 pixels;
uniform float turn;
uniform float reach;         // of the shade, in view space
uniform float strength;
uniform float pixels_per_length;  // at distance 1, or at any in parallel view
uniform int parallel;
uniform float opacity;       // 1 / number of pictures so far
uniform vec3 sky_top;
uniform vec3 sky_bottom;
in vec2 at;
out vec4 shown;
vec3 place(vec2 p) {
  vec4 x = unproject * vec4(2.0 * p - 1.0, 2.0 * texture(depth, p).r - 1.0, 1.0);
  return x.xyz / x.w;
}
void main() {
  vec4 colour = texture(scene, at);
  float z = texture(depth, at).r;
  float across = length((at - vec2(0.5, 0.42)) * vec2(pixels.x / pixels.y, 1.0));
  vec3 sky = mix(sky_top, sky_bottom, smoothstep(0.1, 1.1, across));
  float light = 1.0;
  if (z < 1.0 && strength > 0.0) {
    vec3 x = place(at);
    vec2 px = 1.0 / pixels;
    vec3 r = place(at + vec2(px.x, 0.0)) - x, l = x - place(at - vec2(px.x, 0.0));
    vec3 u = place(at + vec2(0.0, px.y)) - x, d = x - place(at - vec2(0.0, px.y));
    vec3 normal = normalize(cross(abs(r.z) < abs(l.z) ? r : l, abs(u.z) < abs(d.z) ? u : d));
    float disk = reach * pixels_per_length / (parallel == 1 ? 1.0 : -x.z);
    disk = clamp(disk, 3.0, 0.25 * pixels.y);
    float phase = 6.2832 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))) + turn);
    float hidden = 0.0;
    const int n = 14;
    for (int i = 0; i < n; i++) {
      float s = (float(i) + 0.5) / float(n), angle = phase + 2.4 * float(i);
      vec2 p = at + disk * s * vec2(cos(angle), sin(angle)) * px;
      if (texture(depth, p).r >= 1.0) continue;
      vec3 v = place(p) - x;
      float vv = dot(v, v), vn = dot(v, normal) - 0.015 * reach;
      float f = max(1.0 - vv / (reach * reach), 0.0);
      hidden += f * f * max(vn, 0.0) / (sqrt(vv) + 0.02 * reach);
    }
    light = max(0.0, 1.0 - strength * hidden / float(n));
  }
  vec3 over = z < 1.0 ? colour.rgb * light : colour.rgb;
  // What is seen through, where there is nothing behind it, was blended with black of no opacity.
  shown = vec4(z < 1.0 ? over : over + (1.0 - colour.a) * sky, opacity);
}`;

export const copyFragment = `
precision highp float;
precision highp int;
uniform sampler2D scene;
in vec2 at;
out vec4 shown;
void main() { shown = vec4(texture(scene, at).rgb, 1.0); }`;
