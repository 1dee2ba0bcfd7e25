// Runs the lookup in TSL by three.js and Dawn, without a browser: node run_tsl.mjs JOB.json, from a folder that has both packages
// beside the job's module. The job: {module, out, first, mode, levels: [{width, height, file}]}; mode -1 asks for tiles and places of 2^20
// cells, others for values at 2^16 places, as in shader_case.py.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const job = JSON.parse(readFileSync(process.argv[2], 'utf8'));
const { create, globals } = await import(pathToFileURL(createRequire(job.modules + '/').resolve('webgpu')).href);
Object.assign(globalThis, globals);
globalThis.self = globalThis;
const gpu = create([]);
Object.defineProperty(globalThis, 'navigator', { value: { gpu, userAgent: 'node' }, configurable: true });
globalThis.requestAnimationFrame = (f) => setTimeout(() => f(0), 0);
globalThis.cancelAnimationFrame = clearTimeout;
const THREE = await import('three/webgpu');
const { Fn, float, instanceIndex, instancedArray, int, uint, uvec2 } = await import('three/tsl');
const lookup = await import(pathToFileURL(job.module).href);
const adapter = await gpu.requestAdapter();
const device = await adapter.requestDevice();
globalThis.keep = [gpu, adapter, device]; // what the garbage collector takes too early ends the process
const context = { configure() {}, unconfigure() {} };
const canvas = { width: 1, height: 1, style: {}, addEventListener() {}, removeEventListener() {}, getContext: () => context };
const renderer = new THREE.WebGPURenderer({ canvas, device, context });
await renderer.init();

const word = (i, axis) => {
  const h = i.bitXor(uint(axis).mul(uint(0x5bd1e995))).mul(uint(0x9e3779b1)).toVar();
  h.assign(h.bitXor(h.shiftRight(uint(15))).mul(uint(0x85ebca6b)));
  h.assign(h.bitXor(h.shiftRight(uint(13))).mul(uint(0xc2b2ae35)));
  h.assign(h.bitXor(h.shiftRight(uint(16))));
  const near = h.mod(uint(400)).sub(uint(200)).toVar(), kind = i.shiftRight(uint(axis)).bitAnd(uint(3)).toVar();
  const ends = kind.equal(uint(2)).select(near.add(uint(0x80000000)), near.add(uint(0x40000000)));
  return kind.equal(uint(0)).select(h, kind.equal(uint(1)).select(near, ends));
};
const cell = (i, axis) => int(word(i.mul(uint(7)).add(uint(axis)), 0).shiftRight(uint(5)).mod(uint(20))).sub(int(8)).toVar();
const fraction = (i, axis) => float(word(i.mul(uint(11)).add(uint(axis)), 0).shiftRight(uint(7)).bitAnd(uint(1023))).div(1024).toVar();

const values = job.mode >= 0, count = values ? 1 << 16 : 1 << 20;
const out = instancedArray(count, values ? 'vec4' : 'uvec2');
let tiles = null;
if (values) {
  const mipmaps = job.levels.map(({ width, height, file }) => ({ width, height, data: new Uint8Array(readFileSync(file)) }));
  tiles = new THREE.DataTexture(mipmaps[0].data, mipmaps[0].width, mipmaps[0].height, THREE.RGBAFormat);
  Object.assign(tiles, { mipmaps, generateMipmaps: false, wrapS: THREE.RepeatWrapping, wrapT: THREE.RepeatWrapping, needsUpdate: true,
    magFilter: THREE.LinearFilter, minFilter: THREE.LinearMipmapLinearFilter });
}
const program = Fn(() => {
  const i = instanceIndex.add(uint(job.first)).toVar();
  if (!values) {
    const x = int(word(i, 1)).toVar(), y = int(word(i, 2)).toVar();
    out.element(instanceIndex).assign(uvec2(lookup.tilepack_tile(x, y), lookup.tilepack_place(x, y)));
    return;
  }
  const level = float(word(i.mul(uint(13)), 0).shiftRight(uint(9)).mod(uint(job.levels.length))).toVar();
  if (job.mode >= 2) level.addAssign(float(i.mod(uint(4))).mul(0.25));
  const place = [tiles, cell(i, 1), cell(i, 2), fraction(i, 1), fraction(i, 2)];
  const value = job.mode === 0 ? lookup.tilepack_nearest(...place, int(level)) : job.mode === 3 ? lookup.tilepack_exact(...place, level)
    : lookup.tilepack_level(...place, level);
  out.element(instanceIndex).assign(value);
})().compute(count);
await renderer.computeAsync(program);
writeFileSync(job.out, new Uint8Array(await renderer.getArrayBufferAsync(out.value)));
process.exit(0);
