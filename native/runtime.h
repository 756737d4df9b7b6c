/* What the emitted kernel stands on: checks, scratch memory, and the door to Python or to WebAssembly.

   A check that fails notes where in the Python source, and leaves the call: an exception in Python, a
   trap in WebAssembly, after which fault_file, fault_line and fault_kind tell. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#ifdef __wasm__
#define EXPORT(name) __attribute__((export_name(#name)))
#define LEAVE() __builtin_trap()
#else
#include <setjmp.h>
#define EXPORT(name) static
#define LEAVE() longjmp(now.door, 1)
#endif
#ifdef _WIN32
#define SETJMP setjmp
#else
#define SETJMP _setjmp
#endif

enum { BEYOND, DIVIDED, NOT_WHOLE, NO_ROOM };
typedef struct Block { struct Block *below; int64_t size, used; } Block;
typedef struct { Block *top; int64_t used; } Mark;
static _Thread_local struct {
    const char *file;
    int line, kind;
    int64_t index, count;
    Block *top;
#ifndef __wasm__
    jmp_buf door;
#endif
} now;
static Block *spare; /* from call to call; changed while the interpreter's lock is held */
#define WHERE __FILE__, __LINE__
#ifndef MOST_BYTES
#define MOST_BYTES ((int64_t)1 << 40)
#endif

__attribute__((noreturn, cold, noinline))
static void fault(int kind, int64_t index, int64_t count, const char *file, int line) {
    now.kind = kind, now.index = index, now.count = count, now.file = file, now.line = line;
    LEAVE();
}

static inline int64_t row_of(int64_t index, int64_t count, const char *file, int line) {
    if (__builtin_expect((uint64_t)index >= (uint64_t)count, 0)) fault(BEYOND, index, count, file, line);
    return index;
}

static inline int64_t slice_of(int64_t first, int64_t last, int64_t count, const char *file, int line) {
    if (last < 0 || last > count) fault(BEYOND, last, count, file, line);
    if (first < 0 || first > last) fault(BEYOND, first, last, file, line);
    return first;
}

#define ROW(table, k) ((table).at[row_of((k), (table).count, WHERE)])
#define SLICE(type, table, a, b) \
    ((type){(table).at + slice_of((a), (b), (table).count, WHERE), (b) - (a)})

static inline int64_t floor_div(int64_t a, int64_t b, const char *file, int line) {
    if (b == 0) fault(DIVIDED, 0, 0, file, line);
    return a / b - (a % b != 0 && (a < 0) != (b < 0));
}

static inline int64_t whole(double x, const char *file, int line) {
    if (!(fabs(x) < 9e18)) fault(NOT_WHOLE, 0, 0, file, line);
    return (int64_t)x;
}

#define FLOOR_DIV(a, b) floor_div((a), (b), WHERE)
#define FLOOR_MOD(a, b) ((a) - (b) * floor_div((a), (b), WHERE))
#define WHOLE(x) whole((x), WHERE)
/* of two that are alike the first, as Python's */
static inline double min_double(double a, double b) { return b < a ? b : a; }
static inline double max_double(double a, double b) { return b > a ? b : a; }
static inline double abs_double(double a) { return fabs(a); }
static inline int64_t min_int64_t(int64_t a, int64_t b) { return b < a ? b : a; }
static inline int64_t max_int64_t(int64_t a, int64_t b) { return b > a ? b : a; }
static inline int64_t abs_int64_t(int64_t a) { return a < 0 ? -a : a; }

static void *scratch(int64_t count, int64_t size, const char *file, int line) {
    if (count < 0 || count > MOST_BYTES / size) fault(NO_ROOM, count, 0, file, line);
    int64_t bytes = (count * size + 15) & ~(int64_t)15, room = 1 << 20;
    if (!now.top || now.top->used + bytes > now.top->size) {
        while (room < bytes || (now.top && room < 2 * now.top->size)) room *= 2;
        Block *block = malloc(sizeof(Block) + (size_t)room);
        if (!block) fault(NO_ROOM, count, 0, file, line);
        *block = (Block){now.top, room, 0};
        now.top = block;
    }
    char *at = (char *)(now.top + 1) + now.top->used;
    now.top->used += bytes;
#ifdef POISON /* nothing written yet is not a number */
    memset(at, 0xff, (size_t)bytes);
#endif
    return at;
}

#define EMPTY(type, of, n) ((type){scratch((n), sizeof(of), WHERE), (n)})
static void release(Mark until) { /* the lowest block stays, to be used again */
    while (now.top != until.top && now.top->below) {
        Block *block = now.top;
        now.top = block->below;
        free(block);
    }
    if (now.top) now.top->used = now.top == until.top ? until.used : 0;
}

static inline void left_(Mark *since) { release(*since); }
#define KEEP_UNTIL_LEFT \
    __attribute__((cleanup(left_))) Mark since_ = {now.top, now.top ? now.top->used : 0}

static void begin(void) { now.top = spare, spare = NULL; }

static void end(void) {
    release((Mark){NULL, 0});
    if (spare || (now.top && now.top->size > (int64_t)64 << 20)) free(now.top);
    else spare = now.top;
    now.top = NULL;
}

/* A call is a struct of what is given and what is answered. In a text, d is a double, i an integer,
   b a truth value, T and a letter a table of that kind, ( ) a struct, z what begins as nought. */
typedef struct { const char *name, *given, *answer; void (*run)(void *); } Entry;
static const Entry entries[] = { ENTRIES };
static const struct { const char *name; int64_t size; const char *held; } kinds[] = { KINDS };

#if !defined(__wasm__) && !defined(ALONE)
#define Py_LIMITED_API 0x030B0000
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#define MOST_TABLES 24
static PyObject *dtypes, *dtype_name;
typedef struct { Py_buffer held[MOST_TABLES]; int count; const Entry *entry; } Given;

static char *aligned(char *at) { return (char *)(((uintptr_t)at + 7) & ~(uintptr_t)7); }

static int table_in(Given *given, PyObject *value, int kind, char *at) {
    PyObject *own = PyObject_GetAttr(value, dtype_name), *right = PyTuple_GetItem(dtypes, kind);
    int same = own && right ? own == right ? 1 : PyObject_RichCompareBool(own, right, Py_EQ) : -1;
    Py_XDECREF(own);
    if (same < 0) PyErr_Clear();
    Py_buffer *view = &given->held[given->count];
    if (same != 1 || PyObject_GetBuffer(value, view, PyBUF_CONTIG) < 0) {
        PyErr_Format(PyExc_TypeError, "%s: a writable contiguous array of %s is expected",
                     given->entry->name, kinds[kind].name);
        return -1;
    }
    given->count++;
    if (view->ndim != 1) {
        PyErr_Format(PyExc_TypeError, "%s: %s in one row are expected", given->entry->name, kinds[kind].name);
        return -1;
    }
    ((void **)at)[0] = view->buf;
    ((int64_t *)at)[1] = view->shape[0];
    return 0;
}

/* Read one value, by the text, into memory; both move on. */
static int read_in(Given *given, PyObject *value, const char **text, char **at) {
    char kind = *(*text)++;
    if (kind == 'b') {
        int truth = PyObject_IsTrue(value);
        *(bool *)(*at)++ = truth > 0;
        return truth < 0 ? -1 : 0;
    }
    *at = aligned(*at);
    if (kind == 'd') {
        *(double *)*at = PyFloat_AsDouble(value);
        if (*(double *)*at == -1.0 && PyErr_Occurred()) return -1;
    } else if (kind == 'i') {
        *(int64_t *)*at = PyLong_AsLongLong(value);
        if (*(int64_t *)*at == -1 && PyErr_Occurred()) return -1;
    } else if (kind == 'T') {
        if (table_in(given, value, *(*text)++ - 'A', *at) < 0) return -1;
        *at += 8 + sizeof(int64_t);
        return 0;
    } else {
        Py_ssize_t k = 0, count = PyTuple_Check(value) ? PyTuple_Size(value) : 0;
        for (; k < count && **text != ')' && **text != 'z'; k++)
            if (read_in(given, PyTuple_GetItem(value, k), text, at) < 0) return -1;
        if (k < count || (**text != ')' && **text != 'z')) {
            PyErr_Format(PyExc_TypeError, "%s: a tuple of other fields is expected", given->entry->name);
            return -1;
        }
        for (*at = aligned(*at); **text == 'z'; (*text)++, *at += 8) *(int64_t *)*at = 0;
        (*text)++;
        *at = aligned(*at);
        return 0;
    }
    *at += 8;
    return 0;
}

static PyObject *read_out(const char **text, char **at) {
    char kind = *(*text)++;
    if (kind == 'b') return PyBool_FromLong(*(bool *)(*at)++);
    *at = aligned(*at);
    if (kind == '(') {
        int count = 0, depth = 0;
        for (const char *c = *text; depth || *c != ')'; c++) {
            count += !depth;
            depth += (*c == '(') - (*c == ')');
        }
        PyObject *found = PyTuple_New(count);
        for (int k = 0; found && k < count; k++) {
            PyObject *part = read_out(text, at);
            if (!part || PyTuple_SetItem(found, k, part) < 0) { Py_DECREF(found); return NULL; }
        }
        (*text)++;
        *at = aligned(*at);
        return found;
    }
    *at += 8;
    if (kind == 'd') return PyFloat_FromDouble(*(double *)(*at - 8));
    return PyLong_FromLongLong(*(int64_t *)(*at - 8));
}

static PyObject *raised(void) {
    if (now.kind == BEYOND)
        return PyErr_Format(PyExc_IndexError, "%s:%d: row %lld of a table of %lld", now.file, now.line,
                            (long long)now.index, (long long)now.count);
    if (now.kind == DIVIDED)
        return PyErr_Format(PyExc_ZeroDivisionError, "%s:%d: division by zero", now.file, now.line);
    if (now.kind == NOT_WHOLE)
        return PyErr_Format(PyExc_ValueError, "%s:%d: no whole number", now.file, now.line);
    return PyErr_Format(PyExc_MemoryError, "%s:%d: no room for %lld", now.file, now.line,
                        (long long)now.index);
}

static PyObject *call(PyObject *self, PyObject *const *values, Py_ssize_t count) {
    const Entry *entry = PyCapsule_GetPointer(self, NULL);
    Given given = {.count = 0, .entry = entry};
    AnyCall memory;
    char *at = (char *)&memory;
    const char *text = entry->given;
    Py_ssize_t k = 0;
    PyObject *found = NULL;
    for (; *text && k < count; k++)
        if (read_in(&given, values[k], &text, &at) < 0) goto out;
    if (*text || k < count) {
        PyErr_Format(PyExc_TypeError, "%s: other arguments are expected", entry->name);
        goto out;
    }
    begin();
    PyThreadState *state = PyEval_SaveThread();
    int left = SETJMP(now.door);
    if (!left) entry->run(&memory);
    PyEval_RestoreThread(state);
    end();
    text = entry->answer;
    if (left) raised();
    else if (*text) found = read_out(&text, &at);
    else found = Py_NewRef(Py_None);
out:
    while (given.count) PyBuffer_Release(&given.held[--given.count]);
    return found;
}

static PyObject *use_dtypes(PyObject *self, PyObject *given) {
    for (size_t k = 0; k < sizeof(kinds) / sizeof(*kinds); k++) {
        PyObject *own = PyTuple_GetItem(given, (Py_ssize_t)k);
        PyObject *size = own ? PyObject_GetAttrString(own, "itemsize") : NULL;
        if (!size) return NULL;
        long long bytes = PyLong_AsLongLong(size);
        Py_DECREF(size);
        if (bytes != kinds[k].size)
            return PyErr_Format(PyExc_TypeError, "%s is laid out otherwise", kinds[k].name);
    }
    Py_XDECREF(dtypes);
    dtypes = Py_NewRef(given);
    Py_RETURN_NONE;
}

static PyMethodDef calls[sizeof(entries) / sizeof(*entries)];
static PyMethodDef use = {"use_dtypes", use_dtypes, METH_O, "Take the dtypes of KINDS."};
static struct PyModuleDef module = {PyModuleDef_HEAD_INIT, "_native", NULL, -1, NULL};

PyMODINIT_FUNC PyInit__native(void) {
    PyObject *made = PyModule_Create(&module), *names = PyList_New(0);
    dtype_name = PyUnicode_InternFromString("dtype");
    for (size_t k = 0; k < sizeof(entries) / sizeof(*entries); k++) {
        calls[k] = (PyMethodDef){entries[k].name, (PyCFunction)(void (*)(void))call, METH_FASTCALL};
        PyObject *own = PyCapsule_New((void *)&entries[k], NULL, NULL);
        PyModule_AddObject(made, entries[k].name, PyCFunction_New(&calls[k], own));
    }
    for (size_t k = 0; k < sizeof(kinds) / sizeof(*kinds); k++)
        PyList_Append(names, PyUnicode_FromString(kinds[k].name));
    PyModule_AddObject(made, "KINDS", names);
    PyModule_AddObject(made, "use_dtypes", PyCFunction_New(&use, NULL));
    PyModule_AddStringConstant(made, "SOURCE", SOURCE);
    return made;
}
#endif
