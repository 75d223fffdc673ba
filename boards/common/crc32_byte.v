// One byte of the CRC-32 of Ethernet and zlib (polynomial 0x04c11db7, lowest bit first). Begin with all ones; the CRC is
// the complement of the end. Over data followed by its own CRC, low byte first, the end is 0xdebb20e3.
module crc32_byte (
    input  wire [31:0] crc_in,
    input  wire [7:0]  data,
    output reg  [31:0] crc_out
);
    integer i;
    always @* begin
        crc_out = crc_in ^ {24'd0, data};
        for (i = 0; i < 8; i = i + 1) crc_out = {1'b0, crc_out[31:1]} ^ (crc_out[0] ? 32'hedb88320 : 32'd0);
    end
endmodule
