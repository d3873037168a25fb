// The format that a fuzzer of geometry reads: all that differs from one to the next.

extern const char* const kFuzzedFormat;
const char* const kFuzzedFormat = QUASIMC_FUZZ_FORMAT;
