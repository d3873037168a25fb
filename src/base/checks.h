#pragma once

#include <cstdio>
#include <cstdlib>

/// EXPECT(condition): what the caller must guarantee. ENSURE(condition): what this code guarantees.
/// Both end the program with the location of the fault; both are compiled out of release builds.
#ifdef NDEBUG
#define QUASIMC_CHECK(kind, condition) static_cast<void>(sizeof(!(condition)))
#else
#define QUASIMC_CHECK(kind, condition)                                                            \
    ((condition)                                                                                  \
         ? static_cast<void>(0)                                                                   \
         : (std::fprintf(stderr, "%s:%d: %s failed: %s\n", __FILE__, __LINE__, kind, #condition), \
            std::abort()))
#endif
#define EXPECT(condition) QUASIMC_CHECK("EXPECT", condition)
#define ENSURE(condition) QUASIMC_CHECK("ENSURE", condition)
