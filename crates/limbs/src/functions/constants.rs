//! Constants as fractions of limbs, the lowest first, rounded down; `tests/functions.rs` compares what follows from
//! them with MPFR's.

/// π/4
#[rustfmt::skip]
pub(crate) const QUARTER_PI: [u64; 18] = [
    0x8365_5d23_dca3_ad96, 0x6916_3fa8_fd24_cf5f, 0x98da_4836_1c55_d39a, 0xc200_7cb8_a163_bf05, 0x4928_6651_ece4_5b3d,
    0xae9f_2411_7c4b_1fe6, 0xee38_6bfb_5a89_9fa5, 0x0bff_5cb6_f406_b7ed, 0xf44c_42e9_a637_ed6b, 0xe485_b576_625e_7ec6,
    0x4fe1_356d_6d51_c245, 0x302b_0a6d_f25f_1437, 0xef95_19b3_cd3a_431b, 0x514a_0879_8e34_04dd, 0x020b_bea6_3b13_9b22,
    0x2902_4e08_8a67_cc74, 0xc4c6_628b_80dc_1cd1, 0xc90f_daa2_2168_c234,
];

/// log 2
#[rustfmt::skip]
pub(crate) const LOG_2: [u64; 18] = [
    0x610d_30f8_8fe5_51a2, 0x07f4_ca11_fb5b_fb90, 0xda2d_97c5_0f3f_d5c6, 0x655f_a187_2f20_e3a2, 0xf5df_a6bd_3830_3248,
    0x72ce_87b1_9d65_48ca, 0x256f_a0ec_7657_f74b, 0xb9ea_9bc3_b136_603b, 0x1acb_da11_317c_387e, 0x3e96_ca16_224a_e8c5,
    0x2757_3b29_1169_b825, 0xed2e_ae35_c138_2144, 0x5595_52fb_4afa_1b10, 0xe7b8_7620_6deb_ac98, 0x8a0d_175b_8baa_fa2b,
    0x40f3_4326_7298_b62d, 0xc9e3_b398_03f2_f6af, 0xb172_17f7_d1cf_79ab,
];

/// 2/π
#[rustfmt::skip]
pub(crate) const TWO_OVER_PI: [u64; 68] = [
    0xd4e5_4929_10d5_fdfc, 0x91b2_4df3_1700_ad43, 0x4612_c459_c444_c5c8, 0xc277_c912_1426_049b, 0x36d9_cad2_a828_8d61,
    0x818d_67c1_2645_ca55, 0x6f63_a62d_cbbf_f4ef, 0x7873_8a5a_8caf_bdd7, 0x775c_83c2_a388_3c61, 0x0ab4_99d3_f2a6_067f,
    0x425f_aece_616a_a428, 0x4a48_d367_10d8_ddaa, 0xf57f_b0ad_f2e9_1e43, 0x6212_8301_4883_5b8e, 0x1df3_5be0_1834_132e,
    0x08cb_7de0_50c0_17a7, 0x4d58_e232_cac6_16e3, 0x9bde_2822_d2e8_8628, 0x5dd7_de16_de3b_5892, 0xcdc4_ef09_366c_d43f,
    0x6522_89e8_3260_bfe6, 0x9947_fbac_d87f_7eb7, 0xff31_9f6a_1e66_6157, 0x1f00_1b0a_f1df_ce19, 0x2477_8ad6_2354_5ab9,
    0xd9d6_3b38_84a7_cb23, 0xb07a_e715_1756_49c0, 0x64ab_d770_f87c_6357, 0x1810_a3fc_764d_2a9d, 0xa7b4_d555_37f6_3ed7,
    0x9b00_6233_7cd2_b497, 0x467d_862d_71e3_9ac6, 0xc4ad_414d_2c5d_000c, 0x15c6_14b5_9d19_c3c2, 0xfa6e_d577_2d30_433b,
    0x87f1_2190_7c7c_246a, 0x9f3a_1f35_caf2_7f1d, 0xc33d_26ef_6b1e_5ef8, 0x32c2_de4f_9832_7dbb, 0xa5ff_0705_3f7e_33e8,
    0xddaf_44d1_5719_053e, 0x8359_c476_8b96_1ca6, 0x19c3_67cd_dce8_092a, 0x60e2_7bc0_8c6b_47c4, 0x0606_1556_ca73_a8c9,
    0x8dff_d880_4d73_2731, 0x6599_855f_14a0_6840, 0xa9e3_9161_5ee6_1b08, 0xf0cf_bc20_9af4_361d, 0x5603_3046_fc7b_6bab,
    0x6bfb_5fb1_1f8d_5d08, 0x3d07_39f7_8a52_92ea, 0x7527_bac7_ebe5_f17b, 0x4f46_3f66_9e5f_ea2d, 0x6d36_7ecf_27cb_09b7,
    0xef2f_118b_5a0a_6d1f, 0x1ff8_97ff_de05_980f, 0x9c84_5f8b_bdf9_283b, 0x3991_d639_8353_39f4, 0xe99c_7026_b45f_7e41,
    0xe882_35f5_2ebb_4484, 0xfe1d_eb1c_b129_a73e, 0x0649_2eea_09d1_921c, 0xb724_6e3a_424d_d2e0, 0xfe51_63ab_debb_c561,
    0xdb62_9599_3c43_9041, 0xfc27_57d1_f534_ddc0, 0xa2f9_836e_4e44_1529,
];
