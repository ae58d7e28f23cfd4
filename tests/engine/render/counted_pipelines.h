// Counts compiled pipelines: the test program replaces vkCreateGraphicsPipelines of the Vulkan loader.
#pragma once

namespace gearshift::test {

extern int compiled_pipelines;  // number of pipelines compiled so far

}  // namespace gearshift::test
