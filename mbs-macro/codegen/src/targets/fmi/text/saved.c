/* Saved states: copies of the memory of an instance, which belong to any instance of this export. */

struct saved {
    char token[sizeof TOKEN];
    struct memory memory;
};

static int save(struct instance *it, void **state)
{
    struct saved *const saved = *state ? *state : calloc(1, sizeof *saved);
    if (!saved) {
        return say(it, WRONG, "there is no memory for a saved state");
    }
    memcpy(saved->token, TOKEN, sizeof TOKEN);
    memcpy(&saved->memory, &it->now, sizeof it->now);
    saved->memory.run.mechanism = NULL;
    *state = saved;
    return FINE;
}

static int restore(struct instance *it, const void *state)
{
    if (!state) {
        return say(it, WRONG, "there is no saved state");
    }
    memcpy(&it->now, &((const struct saved *)state)->memory, sizeof it->now);
    it->now.run.mechanism = &it->now.mechanism;
    return FINE;
}

static int forget(void **state)
{
    if (state) {
        free(*state);
        *state = NULL;
    }
    return FINE;
}

static int write_bytes(const struct instance *it, const void *state, void *bytes, size_t size)
{
    if (!state || size < sizeof(struct saved)) {
        return say(it, WRONG, "a saved state takes %lu bytes", (unsigned long)sizeof(struct saved));
    }
    memcpy(bytes, state, sizeof(struct saved));
    return FINE;
}

static int read_bytes(const struct instance *it, const void *bytes, size_t size, void **state)
{
    if (size < sizeof(struct saved) || memcmp(bytes, TOKEN, sizeof TOKEN) != 0) {
        return say(it, WRONG, "these bytes are no state of this export");
    }
    if (!*state) {
        *state = malloc(sizeof(struct saved));
    }
    if (!*state) {
        return say(it, WRONG, "there is no memory for a saved state");
    }
    memcpy(*state, bytes, sizeof(struct saved));
    return FINE;
}

