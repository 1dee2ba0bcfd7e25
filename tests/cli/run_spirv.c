/* Draws one picture by a fragment program in SPIR-V, on any Vulkan 1.3 device, without a window:
 *
 *   run_spirv PROGRAM.spv WIDTH HEIGHT words|floats OUT [TEXTURE ...]
 *
 * The picture, two words of 32 bits or four floats a pixel, goes to OUT, the top row first. Each TEXTURE is
 *
 *   BINDING,FILE,ids|texels,nearest|linear,repeat|clamp,LAYERS,WIDTHxHEIGHT[,WIDTHxHEIGHT ...]
 *
 * FILE holds its levels, finest first, texels of four floats (`texels`) or of 16 bits (`ids`); LAYERS is 0 for a texture that
 * is no array. It is bound as an image with its sampler, and the image and the sampler of the last one again alone: the
 * image at 20 + BINDING and the sampler at 19, for programs that keep the two apart. Exit code 2: no such device. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

#define CHECK(call) check(call, #call)

static void fail(const char *what, int code) {
  fprintf(stderr, "%s\n", what);
  exit(code);
}

static void check(VkResult result, const char *call) {
  if (result == VK_SUCCESS) return;
  fprintf(stderr, "%s: %d\n", call, (int)result);
  exit(1);
}

static VkPhysicalDevice gpu;
static VkDevice device;
static VkQueue queue;
static VkCommandPool pool;

static void *read_file(const char *name, size_t *size) {
  FILE *file = fopen(name, "rb");
  void *data;
  if (!file) fail(name, 1);
  fseek(file, 0, SEEK_END);
  *size = (size_t)ftell(file);
  rewind(file);
  data = malloc(*size + 4);
  if (!data || fread(data, 1, *size, file) != *size) fail(name, 1);
  fclose(file);
  return data;
}

static uint32_t memory_type(uint32_t bits, VkMemoryPropertyFlags wanted) {
  VkPhysicalDeviceMemoryProperties memory;
  uint32_t i;
  vkGetPhysicalDeviceMemoryProperties(gpu, &memory);
  for (i = 0; i < memory.memoryTypeCount; ++i)
    if ((bits >> i & 1u) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
  fail("no such memory", 1);
  return 0;
}

static void open_device(void) {
  const float priority = 1;
  const VkApplicationInfo about = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO, .apiVersion = VK_API_VERSION_1_3};
  const VkInstanceCreateInfo asked = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, .pApplicationInfo = &about};
  VkPhysicalDeviceVulkan13Features features = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES, .dynamicRendering = VK_TRUE};
  const VkDeviceQueueCreateInfo queues = {
      .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
  const VkDeviceCreateInfo wanted = {
      .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .pNext = &features, .queueCreateInfoCount = 1, .pQueueCreateInfos = &queues};
  const VkCommandPoolCreateInfo commands = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  VkPhysicalDeviceProperties properties;
  VkInstance instance;
  uint32_t count = 1;
  if (vkCreateInstance(&asked, NULL, &instance) != VK_SUCCESS) fail("no Vulkan", 2);
  if (vkEnumeratePhysicalDevices(instance, &count, &gpu) < 0 || count == 0) fail("no Vulkan device", 2);
  vkGetPhysicalDeviceProperties(gpu, &properties);
  if (properties.apiVersion < VK_API_VERSION_1_3) fail("no device of Vulkan 1.3", 2);
  printf("%s\n", properties.deviceName);
  CHECK(vkCreateDevice(gpu, &wanted, NULL, &device));
  vkGetDeviceQueue(device, 0, 0, &queue);
  CHECK(vkCreateCommandPool(device, &commands, NULL, &pool));
}

/* A buffer that the host sees, mapped. */
static VkBuffer host_buffer(size_t size, VkBufferUsageFlags usage, void **at) {
  const VkBufferCreateInfo asked = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = size, .usage = usage};
  VkMemoryAllocateInfo wanted = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  VkMemoryRequirements needs;
  VkDeviceMemory memory;
  VkBuffer buffer;
  CHECK(vkCreateBuffer(device, &asked, NULL, &buffer));
  vkGetBufferMemoryRequirements(device, buffer, &needs);
  wanted.allocationSize = needs.size;
  wanted.memoryTypeIndex =
      memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  CHECK(vkAllocateMemory(device, &wanted, NULL, &memory));
  CHECK(vkBindBufferMemory(device, buffer, memory, 0));
  CHECK(vkMapMemory(device, memory, 0, size, 0, at));
  return buffer;
}

static VkImage new_image(VkImageCreateInfo asked, VkImageViewType type, VkImageView *view) {
  VkMemoryAllocateInfo wanted = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  VkImageViewCreateInfo seen = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, .viewType = type, .format = asked.format};
  VkMemoryRequirements needs;
  VkDeviceMemory memory;
  VkImage image;
  asked.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  asked.imageType = VK_IMAGE_TYPE_2D;
  asked.samples = VK_SAMPLE_COUNT_1_BIT;
  CHECK(vkCreateImage(device, &asked, NULL, &image));
  vkGetImageMemoryRequirements(device, image, &needs);
  wanted.allocationSize = needs.size;
  wanted.memoryTypeIndex = memory_type(needs.memoryTypeBits, 0);
  CHECK(vkAllocateMemory(device, &wanted, NULL, &memory));
  CHECK(vkBindImageMemory(device, image, memory, 0));
  seen.image = image;
  seen.subresourceRange = (VkImageSubresourceRange){VK_IMAGE_ASPECT_COLOR_BIT, 0, asked.mipLevels, 0, asked.arrayLayers};
  CHECK(vkCreateImageView(device, &seen, NULL, view));
  return image;
}

static VkCommandBuffer begin_commands(void) {
  const VkCommandBufferAllocateInfo asked = {
      .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, .commandPool = pool, .commandBufferCount = 1};
  const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  VkCommandBuffer commands;
  CHECK(vkAllocateCommandBuffers(device, &asked, &commands));
  CHECK(vkBeginCommandBuffer(commands, &begin));
  return commands;
}

static void run_commands(VkCommandBuffer commands) {
  const VkSubmitInfo submitted = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
  CHECK(vkEndCommandBuffer(commands));
  CHECK(vkQueueSubmit(queue, 1, &submitted, VK_NULL_HANDLE));
  CHECK(vkQueueWaitIdle(queue));
}

static void change_layout(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to) {
  const VkImageMemoryBarrier barrier = {
      .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
      .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
      .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
      .oldLayout = from,
      .newLayout = to,
      .image = image,
      .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}};
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, NULL, 0, NULL, 1,
                       &barrier);
}

typedef struct {
  uint32_t binding;
  VkDescriptorImageInfo bound;
} Texture;

static Texture read_texture(char *text) {
  VkBufferImageCopy copies[32];
  VkExtent3D sizes[32];
  char *words[48];
  uint32_t count = 0, levels, i, layers, images;
  size_t size, at = 0, texel;
  void *data, *staged;
  Texture texture = {0};
  VkImage image;
  VkBuffer buffer;
  VkCommandBuffer commands;
  for (char *word = strtok(text, ","); word && count < 48; word = strtok(NULL, ",")) words[count++] = word;
  if (count < 7) fail("a texture needs seven words", 1);
  const int ids = strcmp(words[2], "ids") == 0, linear = strcmp(words[3], "linear") == 0;
  levels = count - 6;
  layers = (uint32_t)atoi(words[5]);
  images = layers ? layers : 1;
  texel = ids ? 2 : 16;
  data = read_file(words[1], &size);
  buffer = host_buffer(size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, &staged);
  memcpy(staged, data, size);
  for (i = 0; i < levels; ++i) {
    sizes[i].depth = 1;
    if (sscanf(words[6 + i], "%ux%u", &sizes[i].width, &sizes[i].height) != 2) fail(words[6 + i], 1);
    copies[i] = (VkBufferImageCopy){at, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, i, 0, images}, {0, 0, 0}, sizes[i]};
    at += texel * images * sizes[i].width * sizes[i].height;
  }
  if (at != size) fail("a file of another size than its levels", 1);
  image = new_image((VkImageCreateInfo){.format = ids ? VK_FORMAT_R16_UINT : VK_FORMAT_R32G32B32A32_SFLOAT,
                                        .extent = sizes[0],
                                        .mipLevels = levels,
                                        .arrayLayers = images,
                                        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT},
                    layers ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D, &texture.bound.imageView);
  commands = begin_commands();
  change_layout(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  vkCmdCopyBufferToImage(commands, buffer, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, levels, copies);
  change_layout(commands, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  run_commands(commands);
  {
    const VkFilter filter = linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
    const VkSamplerAddressMode beyond =
        strcmp(words[4], "repeat") == 0 ? VK_SAMPLER_ADDRESS_MODE_REPEAT : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    const VkSamplerCreateInfo sampler = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                         .magFilter = filter,
                                         .minFilter = filter,
                                         .mipmapMode = linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                         .addressModeU = beyond,
                                         .addressModeV = beyond,
                                         .maxLod = (float)(levels - 1)};
    CHECK(vkCreateSampler(device, &sampler, NULL, &texture.bound.sampler));
  }
  texture.bound.imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  texture.binding = (uint32_t)atoi(words[0]);
  free(data);
  return texture;
}

/* gl_Position = vec4(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1, 0, 1) */
static const char *const vertex_name = "triangle.spv";

static VkShaderModule module_of(const char *name) {
  size_t size;
  uint32_t *code = read_file(name, &size);
  const VkShaderModuleCreateInfo asked = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = size, .pCode = code};
  VkShaderModule module;
  CHECK(vkCreateShaderModule(device, &asked, NULL, &module));
  return module;
}

static VkDescriptorSet bind_textures(const Texture *textures, uint32_t count, VkPipelineLayout *layout) {
  VkDescriptorSetLayoutBinding bindings[20];
  VkWriteDescriptorSet writes[20];
  VkDescriptorPoolSize sizes[3] = {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 8}, {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 8}, {VK_DESCRIPTOR_TYPE_SAMPLER, 8}};
  VkDescriptorSetLayoutCreateInfo laid = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, .pBindings = bindings};
  VkDescriptorPoolCreateInfo pooled = {
      .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, .maxSets = 1, .poolSizeCount = 3, .pPoolSizes = sizes};
  VkPipelineLayoutCreateInfo piped = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, .setLayoutCount = 1};
  VkDescriptorSetAllocateInfo asked = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, .descriptorSetCount = 1};
  VkDescriptorSetLayout set_layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  uint32_t i, bound = 0;
  for (i = 0; i < count; ++i) {
    const VkDescriptorType types[3] = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_SAMPLER};
    const uint32_t at[3] = {textures[i].binding, 20 + textures[i].binding, 19};
    uint32_t k;
    for (k = 0; k < (i == 0 ? 3u : 2u); ++k) {
      bindings[bound] = (VkDescriptorSetLayoutBinding){at[k], types[k], 1, VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
      writes[bound++] = (VkWriteDescriptorSet){.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                               .dstBinding = at[k],
                                               .descriptorCount = 1,
                                               .descriptorType = types[k],
                                               .pImageInfo = &textures[i].bound};
    }
  }
  laid.bindingCount = bound;
  CHECK(vkCreateDescriptorSetLayout(device, &laid, NULL, &set_layout));
  piped.pSetLayouts = &set_layout;
  CHECK(vkCreatePipelineLayout(device, &piped, NULL, layout));
  CHECK(vkCreateDescriptorPool(device, &pooled, NULL, &asked.descriptorPool));
  asked.pSetLayouts = &set_layout;
  CHECK(vkAllocateDescriptorSets(device, &asked, &set));
  for (i = 0; i < bound; ++i) writes[i].dstSet = set;
  vkUpdateDescriptorSets(device, bound, writes, 0, NULL);
  return set;
}

static VkPipeline pipeline_of(const char *fragment, VkFormat format, VkExtent2D size, VkPipelineLayout layout) {
  const VkPipelineShaderStageCreateInfo stages[2] = {{.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                      .stage = VK_SHADER_STAGE_VERTEX_BIT,
                                                      .module = module_of(vertex_name),
                                                      .pName = "main"},
                                                     {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                      .stage = VK_SHADER_STAGE_FRAGMENT_BIT,
                                                      .module = module_of(fragment),
                                                      .pName = "main"}};
  const VkPipelineVertexInputStateCreateInfo vertices = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  const VkPipelineInputAssemblyStateCreateInfo assembly = {.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
                                                           .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
  const VkViewport viewport = {0, 0, (float)size.width, (float)size.height, 0, 1};
  const VkRect2D scissor = {{0, 0}, size};
  const VkPipelineViewportStateCreateInfo views = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
                                                   .viewportCount = 1,
                                                   .pViewports = &viewport,
                                                   .scissorCount = 1,
                                                   .pScissors = &scissor};
  const VkPipelineRasterizationStateCreateInfo raster = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1};
  const VkPipelineMultisampleStateCreateInfo samples = {.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
                                                        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
  const VkPipelineColorBlendAttachmentState all = {.colorWriteMask = 15};
  const VkPipelineColorBlendStateCreateInfo blend = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO, .attachmentCount = 1, .pAttachments = &all};
  const VkPipelineRenderingCreateInfo rendering = {
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO, .colorAttachmentCount = 1, .pColorAttachmentFormats = &format};
  const VkGraphicsPipelineCreateInfo asked = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                              .pNext = &rendering,
                                              .stageCount = 2,
                                              .pStages = stages,
                                              .pVertexInputState = &vertices,
                                              .pInputAssemblyState = &assembly,
                                              .pViewportState = &views,
                                              .pRasterizationState = &raster,
                                              .pMultisampleState = &samples,
                                              .pColorBlendState = &blend,
                                              .layout = layout};
  VkPipeline pipeline;
  CHECK(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &asked, NULL, &pipeline));
  return pipeline;
}

int main(int count, char **words) {
  Texture textures[4];
  uint32_t i, bound;
  void *pixels;
  if (count < 6 || count > 10) fail("run_spirv PROGRAM.spv WIDTH HEIGHT words|floats OUT [TEXTURE ...]", 1);
  open_device();
  const VkExtent2D size = {(uint32_t)atoi(words[2]), (uint32_t)atoi(words[3])};
  const int floats = strcmp(words[4], "floats") == 0;
  const VkFormat format = floats ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32G32_UINT;
  const size_t bytes = (size_t)size.width * size.height * (floats ? 16 : 8);
  for (i = 6; i < (uint32_t)count; ++i) textures[i - 6] = read_texture(words[i]);
  bound = (uint32_t)count - 6;
  VkPipelineLayout layout;
  const VkDescriptorSet set = bind_textures(textures, bound, &layout);
  const VkPipeline pipeline = pipeline_of(words[1], format, size, layout);
  VkImageView view;
  const VkImage picture = new_image((VkImageCreateInfo){.format = format,
                                                        .extent = {size.width, size.height, 1},
                                                        .mipLevels = 1,
                                                        .arrayLayers = 1,
                                                        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
                                    VK_IMAGE_VIEW_TYPE_2D, &view);
  const VkBuffer result = host_buffer(bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &pixels);
  const VkRenderingAttachmentInfo color = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                           .imageView = view,
                                           .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                           .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
  const VkRenderingInfo rendering = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                     .renderArea = {{0, 0}, size},
                                     .layerCount = 1,
                                     .colorAttachmentCount = 1,
                                     .pColorAttachments = &color};
  const VkBufferImageCopy copy = {
      0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {0, 0, 0}, {size.width, size.height, 1}};
  const VkCommandBuffer commands = begin_commands();
  change_layout(commands, picture, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  vkCmdBeginRendering(commands, &rendering);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  if (bound) vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, NULL);
  vkCmdDraw(commands, 3, 1, 0, 0);
  vkCmdEndRendering(commands);
  change_layout(commands, picture, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  vkCmdCopyImageToBuffer(commands, picture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, result, 1, &copy);
  run_commands(commands);
  {
    FILE *file = fopen(words[5], "wb");
    if (!file || fwrite(pixels, 1, bytes, file) != bytes || fclose(file) != 0) fail(words[5], 1);
  }
  return 0;
}
