#pragma once

/// Marks a loop that is compiled for several vector units, the best of which is chosen when the
/// program starts. All variants compute the same bits: each element by the same operations, of
/// which none are contracted. Off where the compiler has no such thing, where sanitizers forbid it,
/// and by QUASIMC_NO_MULTIVERSION.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) && \
    defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) &&  \
    !defined(QUASIMC_NO_MULTIVERSION)
#define QUASIMC_MULTIVERSION __attribute__((target_clones("default", "avx2", "arch=x86-64-v4")))
#else
#define QUASIMC_MULTIVERSION
#endif
