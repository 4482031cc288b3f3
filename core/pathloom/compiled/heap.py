"""A binary heap of items with keys, for kernels that search."""

from pathloom.compiled.jit import part


@part("i8(i4[::1], i4[::1], f8[::1], i8, i8)")
def push(heap, place, key, size, item):
    """Put an item into the heap, or move it up after its key fell; return the size."""
    i = place[item]
    if i < 0:
        i = size
        size += 1
    while i > 0:
        up = (i - 1) // 2
        if key[heap[up]] <= key[item]:
            break
        heap[i] = heap[up]
        place[heap[i]] = i
        i = up
    heap[i] = item
    place[item] = i
    return size


@part("i8(i4[::1], i4[::1], f8[::1], i8)")
def pop(heap, place, key, size):
    """Take the item with the least key out of the heap of this size; place[item] becomes −1."""
    least = heap[0]
    place[least] = -1
    last = heap[size - 1]
    size -= 1
    i = 0
    while size > 0:
        down = 2 * i + 1
        if down >= size:
            break
        if down + 1 < size and key[heap[down + 1]] < key[heap[down]]:
            down += 1
        if key[heap[down]] >= key[last]:
            break
        heap[i] = heap[down]
        place[heap[i]] = i
        i = down
    if size > 0:
        heap[i] = last
        place[last] = i
    return least
