'use strict';
// What the page of a scene has beside that of a pack: the graph as a shader, its textures, the time.
let sceneTextures = [], overviews = [], wordsTexture = null, words = null, playing = false;

// The maps that are read for what is wanted(), as far as the graphics unit has room for their textures.
function sceneMaps(want) {
  const most = gl.getParameter(gl.MAX_TEXTURE_IMAGE_UNITS), shown = choices.map.indexOf(want.map);
  const more = ['normal', 'roughness', 'height'].filter((name) => want['has_' + name]).map(role);
  const list = [shown];
  for (const map of more) if (sceneSamplers([...list, map]).length + 1 + list.length + 1 <= most) list.push(map);
  return list;
}
function sceneParts(list) {
  const order = [];
  for (const map of list) for (const needed of [...pack.scene.parts[map].needs, map]) if (!order.includes(needed)) order.push(needed);
  return order;
}
function sceneSamplers(list) { return [...new Set(sceneParts(list).flatMap((map) => pack.scene.parts[map].samplers))]; }

function sceneReaders(want) {
  const { scene, maps } = pack, list = sceneMaps(want), shown = list[0];
  const kind = (s) => s.ids ? 'usampler2D' : s.array ? 'sampler2DArray' : 'sampler2D';
  const uniforms = sceneSamplers(list).map((s) => `uniform ${kind(scene.samplers[s])} ${scene.samplers[s].name};`).join('\n');
  const seen = (map) => `uniform sampler2D overview_${map};
vec4 seen_${map}(vec2 p, vec4 d) {
  vec4 c = d * vec4(${scene.cells.map(real)}, ${scene.cells.map(real)});
  float a = dot(c.xy, c.xy), b = dot(c.zw, c.zw), wide = sqrt(max(a, b)), narrow = sqrt(min(a, b));
  uvec2 from = uvec2(base);
  float probe = max(narrow, wide / aniso), far = clamp((0.5 * log2(max(wide * narrow, 1e-9)) - 1.0) / ${real(scene.fade)}, 0.0, 1.0);
  vec3 shares = vec3(1.0, 0.0, 0.0);  // of 1, 2 x 2 and 4 x 4 places all over the pixel
  if (filter_mode == 2) far = 0.0;
  else if (probe > 0.5) shares = max(1.0 - abs(log2(min(probe, 2.0)) - vec3(-1.0, 0.0, 1.0)), 0.0);
  vec4 sum = vec4(0.0);
  // One call alone: compilers put the whole scene in its place.
  for (int n = 0; n < (far >= 1.0 ? 0 : shares.z > 0.0 ? 21 : shares.y > 0.0 ? 5 : 1); ++n) {
    int b = n < 1 ? 0 : n < 5 ? 1 : 2, i = n < 1 ? 0 : n < 5 ? n - 1 : n - 5;
    float share = shares[b], part = float(1 << b);
    if (!(share > 0.0)) continue;
    vec2 o = (vec2(i & ((1 << b) - 1), i >> b) + 0.5) / part - 0.5;
    sum += share / (part * part) * scene_${map}(place_at(from, p + o.x * d.xy + o.y * d.zw), d / part);
  }
  vec2 units = vec2(${pack.virtual.map(real)});
  if (far > 0.0) sum = mix(sum, textureGrad(overview_${map}, base_share + p / units, d.xy / units, d.zw / units), far);
  return sum;
}`;
  // What isn't covered: a board where the map has alpha, else what the map has there.
  const shownText = (map) => {
    const m = maps[map], nothing = m.role === 'normal' ? 'vec3(0.5, 0.5, 1.0)' : 'vec3(0.0)';
    const board = 'vec3(mod(floor(gl_FragCoord.x / 8.0) + floor(gl_FragCoord.y / 8.0), 2.0) * 0.05 + 0.05)';
    return `vec4(v.rgb + (1.0 - v.a) * ${m.alpha ? board : nothing}, 1.0)`;
  };
  const reader = (name, map) => `vec4 ${name}_at(vec2 p, vec4 d) { ${list.includes(map) ? `vec4 v = seen_${map}(p, d); return ${shownText(map)}` : 'return vec4(0.5)'}; }`;
  return `uniform float aniso; uniform vec2 base_share;
${scene.common}
${uniforms}
${sceneParts(list).map((map) => scene.parts[map].text).join('\n')}
${list.map(seen).join('\n')}
${reader('shown', shown)}
${reader('normals', role('normal'))}
${reader('rough', role('roughness'))}
${reader('heights', role('height'))}
float level_at(vec4 d) { vec4 t = d * ${real(pack.tile[0])}; return 0.5 * log2(max(max(dot(t.xy, t.xy), dot(t.zw, t.zw)), 1e-30)); }
uint id_of(ivec2 cell) { return 0u; }`;
}
function real(value) { const text = String(value); return /[.e]/.test(text) ? text : text + '.0'; }

function bindScene(want, at, bind) {
  const { scene } = pack, list = sceneMaps(want);
  if (words) moveSprites();
  for (const s of sceneSamplers(list)) {
    const { name, array } = scene.samplers[s], kind = array ? gl.TEXTURE_2D_ARRAY : gl.TEXTURE_2D;
    bind(name, kind, sceneTextures[s]);
    if (anisotropy && sceneTextures[s] && !scene.samplers[s].ids) gl.texParameterf(kind, anisotropy.TEXTURE_MAX_ANISOTROPY_EXT, state.fly && state.filter === 'texture' ? state.aniso : 1);
  }
  for (const map of list) bind(`overview_${map}`, gl.TEXTURE_2D, overviews[map]);
  bind('tables', gl.TEXTURE_2D, wordsTexture);
  gl.uniform1f(at('now'), state.time);
  gl.uniform1f(at('aniso'), state.fly && anisotropy ? state.aniso : 1);
  gl.uniform2f(at('base_share'), Math.floor(state.x) / pack.virtual[0], Math.floor(state.y) / pack.virtual[1]);
}

async function openScene() {
  const { scene } = pack;
  const open = async (s) => {
    if (s.ids) return idsTexture(s.data, s.width, s.height);
    return texture(s, s.array ? gl.TEXTURE_2D_ARRAY : gl.TEXTURE_2D, s.layers);
  };
  [sceneTextures, overviews] = [await Promise.all(scene.samplers.map(open)), await Promise.all(scene.overviews.map((o) => texture(o, gl.TEXTURE_2D)))];
  for (const name of overviews) {
    gl.bindTexture(gl.TEXTURE_2D, name);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAX_LEVEL, 1000);
    gl.generateMipmap(gl.TEXTURE_2D);
  }
  words = new Int32Array((await bytes(scene.words)).buffer);
  wordsTexture = whole(gl.R32I, gl.RED_INTEGER, gl.INT, 2048, words.length / 2048, words);
}

// Sprites on paths as they lie now: closed curves through their points (Catmull-Rom), each stretch of which takes the same time.
let movedAt = null;
function moveSprites() {
  const { scene } = pack;
  if (!scene.sprites.some((set) => set.moving.length) || movedAt === state.time) return;
  movedAt = state.time;
  const bits = new Float32Array(words.buffer);
  for (const { cells, moving } of scene.sprites) for (const s of moving) {
    const count = s.path.length, rounds = s.start + state.time / s.period, at = (rounds - Math.floor(rounds)) * count;
    const stretch = Math.floor(at) % count, t = at - Math.floor(at);
    const along = (axis) => {
      const [a, b, c, d] = [0, 1, 2, 3].map((k) => s.path[(stretch + k + count - 1) % count][axis]);
      const p = 2 * b, q = c - a, r = 2 * a - 5 * b + 4 * c - d, u = 3 * b - a - 3 * c + d;
      return [0.5 * (p + t * (q + t * (r + t * u))), 0.5 * (q + t * (2 * r + t * 3 * u))];
    };
    const [[x, slopeX], [y, slopeY]] = [along(0), along(1)];
    const angle = 2 * Math.PI * s.rotate + (s.follows ? Math.atan2(slopeY, slopeX) : 0), w = s.word;
    words[w] = ((Math.floor(x) % cells[0]) + cells[0]) % cells[0];
    words[w + 1] = ((Math.floor(y) % cells[1]) + cells[1]) % cells[1];
    bits[w + 3] = x - Math.floor(x);
    bits[w + 4] = y - Math.floor(y);
    bits[w + 6] = Math.cos(angle);
    bits[w + 7] = Math.sin(angle);
  }
  gl.bindTexture(gl.TEXTURE_2D, wordsTexture);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 2048, words.length / 2048, gl.RED_INTEGER, gl.INT, words);
}

function addTime() {
  slide('time', 'Time', 0, 200, 0.25);
  const button = document.createElement('button');
  button.textContent = 'Play';
  button.style.gridColumn = '1 / 3';
  document.getElementById('controls').append(button);
  let last = 0;
  const step = (time) => {
    if (!playing) return;
    state.time += Math.min((time - last) / 1000, 0.1) * 12;  // steps a second
    last = time;
    draw();
    fill();
    requestAnimationFrame(step);
  };
  button.addEventListener('click', () => {
    playing = !playing;
    button.textContent = playing ? 'Stop' : 'Play';
    last = performance.now();
    if (playing) requestAnimationFrame(step);
    else writeAddress();
  });
}
