// Pictures as numbers.

/** The pixels of a PNG, decoded by the browser: {width, height, data}, four bytes each. */
export async function pixelsOf(page, png) {
  const { width, height, text } = await page.evaluate(async (base64) => {
    const picture = new Image();
    picture.src = `data:image/png;base64,${base64}`;
    await picture.decode();
    const canvas = document.createElement("canvas");
    canvas.width = picture.width;
    canvas.height = picture.height;
    const pen = canvas.getContext("2d", { willReadFrequently: true });
    pen.drawImage(picture, 0, 0);
    const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
    let bytes = "";
    for (let i = 0; i < data.length; i += 8192) {
      bytes += String.fromCharCode(...data.subarray(i, i + 8192));
    }
    return { width: canvas.width, height: canvas.height, text: btoa(bytes) };
  }, png.toString("base64"));
  return { width, height, data: Buffer.from(text, "base64") };
}

/** How many pixels are as `is(red, green, blue)` says. */
export function countPixels({ data }, is) {
  let count = 0;
  for (let i = 0; i < data.length; i += 4) {
    count += is(data[i], data[i + 1], data[i + 2]) ? 1 : 0;
  }
  return count;
}
