import { Color, DoubleSide, ShaderMaterial, type Vector2, type Vector3, type Vector4 } from "three";

// Shaders of our own: a few lines each, so that they compile at once and run well where there is no graphics card.
// Colours are given and written as screens mix them; only the light is computed with their squares, which is close
// enough to the linear scale.

const SOLID_VERTEX = `
varying vec3 vNormal;
varying vec3 vEye;
varying vec3 vColour;
void main() {
  mat3 shape = mat3(instanceMatrix);
  vec3 squares = vec3(dot(shape[0], shape[0]), dot(shape[1], shape[1]), dot(shape[2], shape[2]));
  vNormal = normalMatrix * (shape * (normal / max(squares, 1e-12)));
  vec4 place = modelViewMatrix * (instanceMatrix * vec4(position, 1.0));
  vEye = -place.xyz;
  vColour = instanceColor;
  gl_Position = projectionMatrix * place;
}`;

// The light hangs above the eye's left shoulder and follows it, so that every view is lit as well as the first. What
// turns away from the eye gets darker, which draws an outline.
const SOLID_FRAGMENT = `
varying vec3 vNormal;
varying vec3 vEye;
varying vec3 vColour;
void main() {
  vec3 n = normalize(vNormal);
  vec3 eye = normalize(vEye);
  const vec3 light = vec3(-0.41, 0.62, 0.67);
  float facing = max(dot(n, eye), 0.0);
  float lit = max(dot(n, light), 0.0);
  float shine = pow(max(dot(n, normalize(light + eye)), 0.0), 48.0);
  vec3 colour = vColour * vColour * (0.46 + 0.14 * n.y + 0.62 * lit) + 0.16 * shine;
  float rim = 1.0 - facing;
  colour *= 1.0 - 0.62 * rim * rim * rim;
  gl_FragColor = vec4(sqrt(colour), 1.0);
}`;

export function solidMaterial(): ShaderMaterial {
  return new ShaderMaterial({ vertexShader: SOLID_VERTEX, fragmentShader: SOLID_FRAGMENT });
}

const SHADOW_VERTEX = `
uniform vec4 plane;
uniform vec3 light;
void main() {
  vec3 place = (instanceMatrix * vec4(position, 1.0)).xyz;
  place -= light * ((dot(plane.xyz, place) - plane.w) / dot(plane.xyz, light));
  gl_Position = projectionMatrix * (modelViewMatrix * vec4(place, 1.0));
}`;

const FLAT_FRAGMENT = `
uniform vec3 tone;
void main() {
  gl_FragColor = vec4(tone, 1.0);
}`;

/**
 * Throws solids flat onto a plane in one tone. Shadows lie on the bare page and are drawn before everything else, so one
 * opaque tone gives even shadows without blending.
 */
export function shadowMaterial(plane: Vector4, light: Vector3): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { plane: { value: plane }, light: { value: light }, tone: { value: new Color() } },
    vertexShader: SHADOW_VERTEX,
    fragmentShader: FLAT_FRAGMENT,
    depthTest: false,
    depthWrite: false,
  });
}

const LINE_VERTEX = `
void main() {
  gl_Position = projectionMatrix * (modelViewMatrix * vec4(position, 1.0));
}`;

/** Lines in one tone. */
export function lineMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { tone: { value: new Color() } },
    vertexShader: LINE_VERTEX,
    fragmentShader: FLAT_FRAGMENT,
  });
}

/** Width of a path in the page's pixels. */
const RIBBON = "1.7";

// Every point of a path is drawn twice, half the width to either side of its tangent as the screen sees it.
const RIBBON_VERTEX = `
uniform vec2 screen;
attribute vec3 along;
attribute float side;
attribute vec3 tint;
varying vec3 vTint;
void main() {
  vTint = tint;
  vec4 here = projectionMatrix * (modelViewMatrix * vec4(position, 1.0));
  vec4 ahead = projectionMatrix * (modelViewMatrix * vec4(position + along, 1.0));
  vec2 way = (ahead.xy / ahead.w - here.xy / here.w) * screen;
  vec2 aside = vec2(-way.y, way.x) / max(length(way), 1e-9);
  here.xy += side * ${RIBBON} * aside / screen * here.w;
  gl_Position = here;
}`;

const RIBBON_FRAGMENT = `
varying vec3 vTint;
void main() {
  gl_FragColor = vec4(vTint, 1.0);
}`;

/** Lines of a constant width on the screen, with a colour for every point. `screen`: its size in the page's pixels. */
export function ribbonMaterial(screen: Vector2): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { screen: { value: screen } },
    vertexShader: RIBBON_VERTEX,
    fragmentShader: RIBBON_FRAGMENT,
    side: DoubleSide,
  });
}
