// Compiled with the precompiled Catch2 header that all tests reuse; it holds nothing itself.
