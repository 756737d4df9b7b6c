/* Recorded calls (recording.py), made again by any compiler's kernel: each told as one number.

   A call in the file: number of the entry, then its values in 8 bytes each; of a table the count of its
   rows, how many of them follow, and these; the others are as the last of them. */
#include "calls.h"

static const uint8_t *given;
static uint64_t told;

static uint64_t next(void) {
    uint64_t value;
    memcpy(&value, given, 8);
    given += 8;
    return value;
}

static void read(char kind, int of, char *at) {
    uint64_t value = kind == 'z' ? 0 : next();
    if (kind == 'b') { *(bool *)at = value; return; }
    memcpy(at, &value, kind == 'T' ? 0 : 8);
    if (kind != 'T') return;
    size_t count = value, follow = next(), size = (size_t)kinds[of].size;
    char *rows = calloc(count + 1, size);
    memcpy(rows, given, follow * size);
    given += (follow * size + 7) & ~(size_t)7;
    for (size_t k = follow; follow && k < count; k++) memcpy(rows + k * size, rows + (follow - 1) * size, size);
    memset(at, 0, 16);
    *(char **)at = rows;
    *(int64_t *)(at + 8) = (int64_t)count;
}

static void tell(char kind, int of, char *at) {
    uint64_t value = 0;
    if (kind == 'T') value = *(uint64_t *)(at + 8);
    else if (kind == 'b') value = *(bool *)at;
    else memcpy(&value, at, 8);
    if (kind == 'd' && *(double *)at != *(double *)at) value = 0x7ff8000000000000; /* of NaN any bits */
    if (kind != 'z') told = told * 0x100000001b3 + value;
    if (kind == 'T') walk_rows(at, of, tell);
}

/* Make one call, which is told; where the next one begins. */
static const uint8_t *call(const uint8_t *from) {
    static AnyCall memory, kept; /* an entry may narrow a table within what it is given */
    given = from;
    const Entry *entry = &entries[next()];
    walk(entry->given, (char *)&memory, read);
    kept = memory;
    begin();
#ifndef __wasm__
    if (SETJMP(now.door)) abort();
#endif
    entry->run(&memory);
    end();
    told = 0;
    char *end_of_given = walk(entry->given, (char *)&kept, tell);
    walk(entry->answer, end_of_given - (char *)&kept + (char *)&memory, tell);
    walk(entry->given, (char *)&kept, free_table);
    return given;
}

#ifdef __wasm__
EXPORT(room) void *room(int64_t size) { return malloc((size_t)size); }
EXPORT(call) const uint8_t *made(const uint8_t *from) { return call(from); }
EXPORT(told) uint64_t told_(void) { return told; }
#else
#include <stdio.h>

int main(int count, char **names) {
    FILE *file = fopen(names[count - 1], "rb");
    if (!file || fseek(file, 0, SEEK_END)) return 1;
    size_t size = (size_t)ftell(file);
    uint8_t *calls = malloc(size);
    rewind(file);
    if (fread(calls, 1, size, file) != size) return 1;
    for (const uint8_t *at = calls; at < calls + size;) {
        at = call(at);
        printf("%016llx\n", (unsigned long long)told);
    }
    return 0;
}
#endif
