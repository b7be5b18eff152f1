// Whether a sanitizer keeps shadows of the memory: programs take terabytes of addresses then, and what they
// allocate is counted elsewhere.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CINCH_SHADOWED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CINCH_SHADOWED
#endif
#endif
