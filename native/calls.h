/* Calls of the emitted kernel without Python: their memory, walked by the texts of its entries. */
#define ALONE
#include KERNEL

typedef void Visit(char kind, int of, char *at);

static char *up_to_8(char *at) { return (char *)(((uintptr_t)at + 7) & ~(uintptr_t)7); }

/* Visit each number, and each table as a pointer and a count; where the text ends in memory. */
static char *walk(const char *text, char *at, Visit *visit) {
    for (; *text; text++) {
        if (*text == 'b') { visit('b', 0, at++); continue; }
        at = up_to_8(at);
        if (*text == '(' || *text == ')') continue;
        int of = *text == 'T' ? text[1] - 'A' : 0;
        visit(*text, of, at);
        at += *text == 'T' ? 8 + sizeof(int64_t) : 8;
        text += *text == 'T';
    }
    return at;
}

static void walk_rows(char *table, int of, Visit *visit) {
    for (int64_t k = 0; k < *(int64_t *)(table + 8); k++)
        walk(kinds[of].held, *(char **)table + k * kinds[of].size, visit);
}

static void free_table(char kind, int of, char *at) {
    (void)of;
    if (kind == 'T') free(*(void **)at);
}
