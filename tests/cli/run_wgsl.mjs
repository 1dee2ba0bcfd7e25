// Runs a compute program by Dawn, without a browser: node run_wgsl.mjs JOB.json
// The job names the text, textures ({binding, layers, format, levels: [{width, height, file}]}), samplers (bindings), how
// many words it writes at binding 0, and the file they go to.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const job = JSON.parse(readFileSync(process.argv[2], 'utf8'));
const { create, globals } = await import(pathToFileURL(createRequire(job.modules + '/').resolve('webgpu')).href);
Object.assign(globalThis, globals);
const keep = (globalThis.keep = []); // what the garbage collector takes too early ends the process
const gpu = create([]);
const adapter = await gpu.requestAdapter();
if (!adapter) {
  console.error('no adapter');
  process.exit(3);
}
const device = await adapter.requestDevice();
keep.push(gpu, adapter, device);
const module = device.createShaderModule({ code: readFileSync(job.text, 'utf8') });
const messages = (await module.getCompilationInfo()).messages.filter((m) => m.type === 'error');
if (messages.length) {
  console.error(messages.map((m) => `${m.lineNum}: ${m.message}`).join('\n'));
  process.exit(4);
}
const pipeline = device.createComputePipeline({ layout: 'auto', compute: { module, entryPoint: 'main' } });
const bytes = job.words * 4;
const out = device.createBuffer({ size: bytes, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
const read = device.createBuffer({ size: bytes, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
const entries = [{ binding: 0, resource: { buffer: out } }];
for (const { binding, layers, format, levels } of job.textures) {
  const texture = device.createTexture({
    size: [levels[0].width, levels[0].height, layers || 1],
    format,
    mipLevelCount: levels.length,
    usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
  });
  levels.forEach(({ width, height, file }, mipLevel) => {
    const data = readFileSync(file);
    device.queue.writeTexture({ texture, mipLevel }, data, { bytesPerRow: data.length / height / (layers || 1), rowsPerImage: height },
      [width, height, layers || 1]);
  });
  entries.push({ binding, resource: texture.createView({ dimension: layers ? '2d-array' : '2d' }) });
  keep.push(texture);
}
for (const binding of job.samplers) {
  const mode = job.repeat ? 'repeat' : 'clamp-to-edge';
  const sampler = device.createSampler({ magFilter: 'linear', minFilter: 'linear', mipmapFilter: 'linear', addressModeU: mode,
    addressModeV: mode });
  entries.push({ binding, resource: sampler });
  keep.push(sampler);
}
const group = device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries });
keep.push(module, pipeline, out, read, group);
const encoder = device.createCommandEncoder();
const pass = encoder.beginComputePass();
pass.setPipeline(pipeline);
pass.setBindGroup(0, group);
pass.dispatchWorkgroups(job.groups, 1, 1);
pass.end();
encoder.copyBufferToBuffer(out, 0, read, 0, bytes);
device.queue.submit([encoder.finish()]);
await read.mapAsync(GPUMapMode.READ);
writeFileSync(job.out, new Uint8Array(read.getMappedRange()));
read.unmap();
console.log(adapter.info.description || adapter.info.device);
device.destroy();
process.exit(0);
