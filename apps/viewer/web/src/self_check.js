// SPDX-License-Identifier: GPL-3.0-or-later
// The page looks at itself: everything decodes, the counts are those of the header, every number is one, every
// element names nodes that are there, and something is drawn. The result is in the page, in words and for a test to read.

const kCounts = { grains: 'grains', nodes: 'nodes', edges: 'edges', facets: 'facets', contacts: 'contacts' };

async function checkFrame(run, k, problems) {
  const frame = run.frames[k];
  let arrays = 0, numbers = 0;
  for (const part of ['grains', 'membranes', 'contacts']) {
    for (const record of await run.records(k, part)) {
      const where = `frame ${k} ${part} ${record.name}`;
      const values = await run.values(record);
      arrays++;
      numbers += values.length;
      const expected = frame[kCounts[record.on]];
      if (expected !== undefined && record.count !== expected) problems.push(`${where}: ${record.count} of ${expected}`);
      if (values.some((v) => !Number.isFinite(v))) problems.push(`${where}: not a number`);
      if (record.name === 'nodes' && values.some((v) => v < 0 || v >= frame.nodes)) problems.push(`${where}: no such node`);
    }
  }
  return { arrays, numbers };
}

/** Share of the picture that differs from its corner, as it is on the screen. */
function drawnShare(stage) {
  stage.finish();
  const gl = stage.renderer.getContext(), w = stage.canvas.width, h = stage.canvas.height;
  const pixels = new Uint8Array(4 * w * h);
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  let drawn = 0;
  for (let i = 0; i < pixels.length; i += 4) {
    const most = Math.max(pixels[i], pixels[i + 1], pixels[i + 2]), least = Math.min(pixels[i], pixels[i + 1], pixels[i + 2]);
    if (most - least > 24 || most < 150) drawn++;
  }
  return drawn / (w * h);
}

export async function selfCheck(run, stage) {
  const problems = [];
  const result = { ok: false, frames: 0, arrays: 0, numbers: 0, histories: 0, drawn: 0, problems };
  try {
    for (let k = 0; k < run.frames.length; k++) {
      const { arrays, numbers } = await checkFrame(run, k, problems);
      result.frames++;
      result.arrays += arrays;
      result.numbers += numbers;
      if (k > 0 && !(run.frames[k].time >= run.frames[k - 1].time)) problems.push(`frame ${k}: earlier than the one before`);
    }
    for (const { file, columns } of await run.histories()) {
      result.histories++;
      if (columns.some((c) => c.values.length !== columns[0].values.length)) problems.push(`${file}: columns of different lengths`);
      if (columns[0].values.some((v) => !Number.isFinite(v))) problems.push(`${file}: a time that is no number`);
    }
    if (stage.renderer.getContext().getError() !== 0) problems.push('an error of WebGL');
    result.drawn = drawnShare(stage);
    if (!(result.drawn > 0)) problems.push('the picture is empty');
  } catch (error) {
    problems.push(String(error));
  }
  result.ok = problems.length === 0;
  return result;
}

/** The result in words. */
export function verdictOf({ ok, frames, numbers, histories, problems }) {
  if (ok) return `Self-check: all is in order; ${frames} frames, ${numbers} numbers and ${histories} histories were read.`;
  const most = 10, more = problems.length - most;
  return `Self-check: not in order: ${problems.slice(0, most).join('; ')}${more > 0 ? `; and ${more} more` : ''}.`;
}
